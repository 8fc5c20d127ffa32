#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# static.sh ARCHITECTURE: makes build/rolling-VERSION-linux-ARCHITECTURE.tar.xz of the static
# programs in TOOLS, with pages, completions, samples, and what they contain of others. Like sources give like bytes.
set -eu
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
case ${1-} in '' | *[!A-Za-z0-9_]*) echo "static: '${1-}' is no architecture" >&2 && exit 2 ;; esac
name=rolling-$(bin/smooth --version | cut -d ' ' -f 3)-linux-$1
mkdir -p build
. cmd/install/scratch.sh
own scratch "build/archive.$$"
bindir=/bin mandir=/share/man datadir=/share docdir=/ PROGRAM_PREFIX='' \
  DESTDIR=$scratch/$name cmd/install/install.sh install >/dev/null
rm "$scratch/$name/installed-files"
cp README.md LICENSE "$scratch/$name"
cmd/install/parts.sh static "$scratch/$name"
chmod -R u=rwX,go=rX "$scratch"
tar -I 'xz -T1' --sort=name --format=ustar --owner=0 --group=0 --numeric-owner \
  --mtime="@$(cmd/install/date.sh)" -C "$scratch" -cf "$scratch/archive" "$name"
mv "$scratch/archive" "build/$name.tar.xz"
echo "build/$name.tar.xz: $(wc -c <"build/$name.tar.xz") bytes"
