#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# parts.sh static|shared FOLDER: what the programs contain of others, linked statically or with shared
# libraries: in FOLDER parts.cdx.json, a list in the form CycloneDX, with versions, licences and where
# the sources are; and NOTICES, with their copyright notices. The versions are those of the headers
# that CXX (g++) reads, the sources and the notices those of Debian's packages.
set -eu
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
[ $# = 2 ] && [ -d "$2" ] || { echo 'parts.sh static|shared FOLDER' >&2; exit 2; }
linked=$1
. cmd/install/scratch.sh
own scratch "$2/.new.$$"
to=$2
rolling=$(bin/smooth --version | cut -d ' ' -f 3)
# shellcheck disable=SC2046  # words
set -- $(${CXX:-g++} -E -P -x c++ - <<'END' | tail -n 1 | tr -d '"'
#include <CLI/Version.hpp>
#include <cstdlib>
#include <fmt/core.h>
#include <gsl/gsl_version.h>
CLI11_VERSION FMT_VERSION GSL_VERSION __GLIBC__ __GLIBC_MINOR__ __VERSION__
END
)
# The header of fmt 10.1.1 calls itself 10.1.0: the package knows better, where there is one.
fmt=$(dpkg-query -W -f '${Version}' libfmt-dev 2>/dev/null | sed 's/[+-].*//') || fmt=''
fmt=${fmt:-$(($2 / 10000)).$(($2 / 100 % 100)).$(($2 % 100))}
compiler=${6%%.*}

# name, version, licence, Debian's package
parts="CLI11 $1 BSD-3-Clause libcli11-dev
fmt $fmt MIT libfmt-dev"
[ "$linked" = shared ] || parts="$parts
GSL $3 GPL-3.0-or-later libgsl-dev
glibc $4.$5 LGPL-2.1-or-later libc6-dev
libstdc++ $6 GPL-3.0-or-later+WITH+GCC-exception-3.1 libstdc++-$compiler-dev"

source_of() {  # PACKAGE: where its source is
  dpkg-query -W -f 'https://snapshot.debian.org/package/${source:Package}/${source:Version}/\n' "$1" \
    2>/dev/null || true
}
{
  printf '{\n  "bomFormat": "CycloneDX",\n  "specVersion": "1.6",\n  "version": 1,\n'
  printf '  "metadata": {"component": {"type": "application", "name": "rolling", "version": "%s",\n' "$rolling"
  printf '    "licenses": [{"expression": "GPL-3.0-or-later"}]}},\n  "components": ['
  comma=''
  while read -r name version licence package; do
    printf '%s\n    {"type": "library", "name": "%s", "version": "%s",\n' "$comma" "$name" "$version"
    printf '     "licenses": [{"expression": "%s"}]' "$(echo "$licence" | sed 's/+WITH+/ WITH /')"
    where=$(source_of "$package")
    [ -z "$where" ] ||
      printf ',\n     "externalReferences": [{"type": "source-distribution", "url": "%s"}]' "$where"
    printf '}'
    comma=,
  done <<END
$parts
END
  printf '\n  ]\n}\n'
} >"$scratch/parts.cdx.json"
{
  echo "Copyright (C) $(date -u -d "@$(cmd/install/date.sh)" +%Y) the authors of rolling"
  echo
  echo "These programs are rolling $rolling, GPL-3.0-or-later: whoever gives them to you owes you the"
  echo 'source of this version. They contain parts of others, whose sources and notices follow.'
  while read -r name version licence package; do
    printf '\n==== %s %s, %s\n' "$name" "$version" "$(echo "$licence" | sed 's/+WITH+/ WITH /')"
    source_of "$package"
    notice=/usr/share/doc/$package/copyright
    if [ -r "$notice" ]; then echo && cat "$notice"
    else echo "parts: no notice of $name in $notice: do not give these programs away" >&2
    fi
  done <<END
$parts
END
  if [ "$linked" = static ]; then
    printf '\n==== LGPL-2.1\n\n'
    cat /usr/share/common-licenses/LGPL-2.1 || true
  fi
} >"$scratch/NOTICES"
mv -f "$scratch"/* "$to"
