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
trap '' INT TERM HUP  # not before the folder has its name
folder=build/archive.$$
mkdir "$folder"  # or it fails: what is removed was made here
trap 'rm -rf "$folder"' EXIT
trap 'trap "" INT TERM HUP; exit 130' INT TERM HUP  # once: a second one would stop the removal
bindir=/bin mandir=/share/man datadir=/share docdir=/ PROGRAM_PREFIX='' \
  DESTDIR=$folder/$name cmd/install/install.sh install >/dev/null
rm "$folder/$name/installed-files"
cp README.md LICENSE "$folder/$name"
cmd/install/parts.sh static "$folder/$name"
chmod -R u=rwX,go=rX "$folder"
tar -I 'xz -T1' --sort=name --format=ustar --owner=0 --group=0 --numeric-owner \
  --mtime="@$(cmd/install/date.sh)" -C "$folder" -cf "$folder/archive" "$name"
mv "$folder/archive" "build/$name.tar.xz"
echo "build/$name.tar.xz: $(wc -c <"build/$name.tar.xz") bytes"
