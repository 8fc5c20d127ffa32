#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages are right mdoc: every warning is an error.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it" && exit 77; }
[ -n "$(ls man/*.[1-8] 2>/dev/null)" ] || { echo "no pages in man/" && exit 1; }
mandoc -Tlint -Wwarning man/*.[1-8] || failed=1
# A Dq or Sq runs to the end of its line: a second one on it stands within the first.
for page in man/*.[1-8]; do
  # shellcheck disable=SC1112
  nested=$(mandoc -Tutf8 "$page" | sed 's/.\x08//g' | grep -nE '“[^”]*“|‘[^’]*‘|””|’’')
  [ -z "$nested" ] || { printf '%s: quotes within quotes:\n%s\n' "$page" "$nested"; failed=1; }
done
exit "${failed:-0}"
