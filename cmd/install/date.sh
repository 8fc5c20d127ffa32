#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# date.sh: the moment that dates a package, in seconds since 1970: SOURCE_DATE_EPOCH, else the last
# commit, else the newest file of the source.
set -eu
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
# git refuses where there is no repository, and in one that belongs to another user.
[ -z "${SOURCE_DATE_EPOCH-}" ] || { echo "$SOURCE_DATE_EPOCH" && exit; }
git log -1 --format=%ct 2>/dev/null ||
  find Makefile cmd lib man samples -type f -printf '%T@\n' | sort -n | tail -n 1 | cut -d . -f 1
