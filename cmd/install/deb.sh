#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# deb.sh: makes build/rolling_VERSION_ARCHITECTURE.deb of what install.sh installs below /usr, with
# the programs in TOOLS.
# PROGRAM_PREFIX goes before the names of the tools. DEBFULLNAME and DEBEMAIL name the maintainer,
# else the author of git's last commit does, else the user. date.sh says of when it is.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
for program in dpkg-shlibdeps dpkg-deb; do
  command -v $program >/dev/null ||
    { echo "deb: $program is not installed; make setup deb installs it" >&2; exit 1; }
done

prefix=${PROGRAM_PREFIX-}
mkdir -p build
. cmd/install/scratch.sh
own scratch "build/deb.$$"
tree=$scratch/debian/rolling
version=$(bin/smooth --version | cut -d ' ' -f 3)
architecture=$(dpkg --print-architecture)
# git refuses where there is no repository, and in one that belongs to another user.
of_commit() { git log -1 --format="$1" 2>/dev/null; }
maintainer=${DEBFULLNAME:-$(of_commit %an || id -un)}
maintainer+=" <${DEBEMAIL:-$(of_commit %ae || echo "$(id -un)@$(uname -n)")}>"
moment=$(cmd/install/date.sh)
umask 022
bindir=/usr/bin mandir=/usr/share/man datadir=/usr/share docdir=/usr/share/doc/rolling \
  DESTDIR=$tree cmd/install/install.sh install >/dev/null
rm "$tree"/usr/share/doc/rolling/installed-files*

strip --strip-unneeded --remove-section=.comment --remove-section=.note "$tree"/usr/bin/*
gzip -9n "$tree"/usr/share/man/man?/*
mkdir "$tree/usr/share/zsh/vendor-completions"  # where Debian's zsh looks
mv "$tree"/usr/share/zsh/site-functions/* "$tree/usr/share/zsh/vendor-completions"
rmdir "$tree/usr/share/zsh/site-functions"

doc=$tree/usr/share/doc/rolling
cat >"$doc/copyright" <<END
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: rolling

Files: *
Copyright: $(date -u -d "@$moment" +%Y) the authors of rolling
Comment: The programs contain code of the headers of CLI11 and fmt, see NOTICES.
License: GPL-3.0+
 This program is free software: you can redistribute it and/or modify it under the terms of the
 GNU General Public License as published by the Free Software Foundation, either version 3 of the
 License, or (at your option) any later version.
 .
 On Debian systems its text is in /usr/share/common-licenses/GPL-3.
END
cmd/install/parts.sh shared "$doc"
gzip -9n >"$doc/changelog.gz" <<END
rolling ($version) unstable; urgency=medium

  * What changed: VERSION AND CHANGES in rolling(7).

 -- $maintainer  $(date -u -R -d "@$moment")
END

mkdir "$tree/DEBIAN"
# dpkg-shlibdeps wants to see this one.
printf 'Source: rolling\n\nPackage: rolling\nArchitecture: any\n' >"$scratch/debian/control"
depends=$(cd "$scratch" && dpkg-shlibdeps -O debian/rolling/usr/bin/*)
cat >"$tree/DEBIAN/control" <<END
Package: rolling
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Installed-Size: $(find "$tree/usr" -printf '%y %s\n' |
  awk '{ k += $1 == "f" ? int(($2 + 1023) / 1024) : 1 } END { print k }')
Depends: ${depends#shlibs:Depends=}
Recommends: gnuplot-nox | gnuplot
Section: science
Priority: optional
Description: from motion-sensor data to the physics of a rolling body
 Six small tools that read plain columns and write plain columns: ${prefix}smooth,
 ${prefix}differentiate, ${prefix}shift-from-accel, ${prefix}fitpower,
 ${prefix}simulate, ${prefix}energy-ledger.
 They find the law D = a v^b by which a soft mat slows a rolling cylinder, with
 standard errors, and account for the energy that is lost.
END
(cd "$tree" && find usr -type f -print0 | sort -z | xargs -0 md5sum >DEBIAN/md5sums)
find "$tree" -exec touch -h -d "@$moment" {} +
package=rolling_${version}_$architecture.deb
SOURCE_DATE_EPOCH=$moment dpkg-deb --root-owner-group --build "$tree" "$scratch/$package" >"$scratch/said"
mv "$scratch/$package" build
echo "build/$package: $(wc -c <"build/$package") bytes"
