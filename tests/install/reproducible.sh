#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Two builds in two folders give the same bytes, whatever the name of the folder, the user's umask,
# time zone and day are: objects and a program of them, the archive and the package of given programs.
# With LONG=1 everything is built there, and the archive and the package are those of make.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
unset DESTDIR PREFIX PROGRAM_PREFIX SOURCE_DATE_EPOCH
export XZ_OPT=-0 DPKG_DEB_COMPRESSOR_LEVEL=0 CCACHE_DISABLE=1 DEBFULLNAME=A DEBEMAIL=a@b.de
export GIT_DIR=/dev/null  # dated by the newest file

build() {  # FOLDER
  mkdir -p "$1/build" && tar -cf - Makefile README.md LICENSE cmd lib man samples tests | tar -xf - -C "$1"
  [ -n "${LONG-}" ] || cp -R bin "$1"
  [ -n "${LONG-}" ] || cp build/lib.a "$1/build"
  cd "$1" || return
  if [ -n "${LONG-}" ]; then make static deb
  else
    # lib.a stays as it is: what is compiled here is compared by itself.
    g=${CXX:-g++}
    make build/cmd/differentiate.o build/lib/contact.o CXX="$g" &&
      make -o build/lib.a bin/differentiate CXX="$g" && mv bin/differentiate build &&
      cp "$top/bin/differentiate" bin && TOOLS=bin cmd/install/static.sh any &&
      if command -v dpkg-shlibdeps; then TOOLS=bin cmd/install/deb.sh; fi
  fi
}
top=$PWD
(build "$scratch/one") >"$scratch/said" 2>&1 || complain "$(tail -n 20 "$scratch/said")"
(umask 077 && TZ=Asia/Tokyo && export TZ && build "$scratch/the second one's") >"$scratch/said" 2>&1 ||
  complain "$(tail -n 20 "$scratch/said")"
cd "$scratch/one" || exit 2
compared=$(find . -name '*.o' -o -name 'rolling-*.tar.xz' -o -name '*.deb' -o -path './build/differentiate' \
  -o -path './build/static/bin/*' -o -path './build/debian/bin/*')
[ "$(wc -l <<<"$compared")" -gt 3 ] || complain "only these were built: $compared"
for file in $compared; do cmp "$file" "$scratch/the second one's/$file" || complain "two builds differ"; done
exit $wrong
