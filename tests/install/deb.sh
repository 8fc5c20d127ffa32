#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The package holds what `make install` installs, its tools run, and lintian finds no error in it and
# no warning. With LONG=1 it is that of `make deb`, whose programs are hardened; without, the programs
# in bin/ are packed.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v dpkg-shlibdeps >/dev/null ||
  { echo "skipped: no dpkg-shlibdeps; make setup deb installs it" && exit 77; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
unset MAKEFLAGS MAKELEVEL DESTDIR PREFIX PROGRAM_PREFIX
[ -n "${LONG-}" ] || export DPKG_DEB_COMPRESSOR_LEVEL=0  # quick
wrong=0
complain() { echo "$*" && wrong=1; }

pack=cmd/install/deb.sh
[ -z "${LONG-}" ] || pack='make deb'
# As outside of git: PATH has a git that refuses, as git does in a folder of another user.
mkdir "$scratch/path" && printf '#!/bin/sh\nexit 128\n' >"$scratch/path/git" && chmod +x "$scratch/path/git"
PATH="$scratch/path:$PATH" TOOLS=bin $pack >"$scratch/made" 2>&1 || { cat "$scratch/made" && exit 1; }
[ -z "${LONG-}" ] || [ -z "$(git log -1 --format=%an 2>/dev/null)" ] || TOOLS=bin $pack >"$scratch/made" 2>&1 ||
  { cat "$scratch/made" && exit 1; }
version=$(bin/smooth --version | cut -d ' ' -f 3)
package=build/rolling_${version}_$(dpkg --print-architecture).deb
[ "$(dpkg-deb --field "$package" Version)" = "$version" ] || complain "its version is not $version"
depends=$(dpkg-deb --field "$package" Depends)
for library in libc6 libstdc++6 libgsl libfmt; do
  grep -q "$library" <<<"$depends" || complain "it does not depend on $library: $depends"
done

[[ $(dpkg-deb --field "$package" Recommends) == *gnuplot* ]] || complain "it does not recommend gnuplot"
dpkg-deb --extract "$package" "$scratch/tree"
make install DESTDIR="$scratch/stage" PREFIX=/usr >"$scratch/made" 2>&1 ||
  { cat "$scratch/made" && exit 1; }
files() { (cd "$1" && find . ! -type d | grep -v installed-files | sed 's/\.gz$//; s|zsh/vendor-completions|zsh/site-functions|' | sort); }
diff <(files "$scratch/stage") <(files "$scratch/tree" | grep -vE '/(changelog|copyright|NOTICES|parts.cdx.json)$') ||
  complain "its files are not those of make install"
for tool in "$scratch"/tree/usr/bin/*; do
  "$tool" --version | grep -qF " $version " || complain "$tool does not run"
done
(cd "$scratch/tree" && dpkg-deb --info "$OLDPWD/$package" md5sums | md5sum --quiet -c) ||
  complain "its md5sums"

doc=$scratch/tree/usr/share/doc/rolling
for name in CLI11 fmt; do
  grep -q "\"name\": \"$name\"" "$doc/parts.cdx.json" && grep -q "^==== $name " "$doc/NOTICES" ||
    complain "$name is no part of it"
done

if command -v lintian >/dev/null; then
  lintian --fail-on error,warning "$package" 2>/dev/null || complain "lintian"
  # What they call of libc has no fortified form, which lintian takes for a flag that is missing.
  [ -z "${LONG-}" ] || ! lintian -I "$package" 2>/dev/null | grep 'hardening-no-[^f]' ||
    complain "its programs are not hardened"
fi
exit $wrong
