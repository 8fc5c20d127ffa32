#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Nothing is half there: a case runs its tool, a file of lib/ that computes has its
# unit test, a test is run, a file that a comment names is there.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
wrong=0
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
complain() { echo "$*" && wrong=1; }

while IFS= read -r file; do
  complain "$file is no file of cases: nobody reads it"
done < <(find tests/tools -type f ! -name '*.cases')
for source in cmd/*.cpp; do
  tool=$(basename "$source" .cpp)
  cases=("tests/tools/$tool"*.cases "tests/tools/$tool"/*.cases)
  cat "${cases[@]}" 2>/dev/null | awk -v tool="$tool" '
    function end() { if (name != "" && !runs) print "the case " name " does not run " tool }
    /^=== / { end(); name = substr($0, 5); runs = 0; command = 1; next }
    /^--- / { command = 0 }
    command && index($0, tool) { runs = 1; ++cases }
    END { end(); if (!cases) print "no cases of " tool }'
done >"$scratch/complaints"
[ ! -s "$scratch/complaints" ] || complain "$(cat "$scratch/complaints")"

# A unit test includes the header of each source of lib/, or that of a source which is made of it.
# Without: what only a command as a whole can show.
included() { sed -nE 's|^#include "([^"]*)\.h".*|\1|p' "$@" | sort -u; }
tested=$(included tests/unit/*/*)
for name in $tested; do
  [ ! -e "lib/$name.h" ] || tested+=$'\n'$(included "lib/$name".*)
done
for source in lib/*/*.cpp; do
  name=${source#lib/}
  name=${name%.cpp}
  [ -e "tests/unit/${name}_test.cpp" ] || grep -qxF "$name" <<<"$tested" ||
    complain "$source: no unit test of it"
done
if grep -rnE '^(<<<<<<<|>>>>>>>)( |$)' Makefile README.md cmd lib tests samples man; then complain "a merge that was not finished"; fi
for script in tests/*.sh tests/*/*.sh; do
  [ -x "$script" ] || complain "$script cannot be run"
done
# What `make results` writes is not in every checkout.
while IFS= read -r file; do
  [ -e "$file" ] || [ "$file" = tests/results.txt ] || complain "a comment names $file, which is not there"
done < <(grep -rhoE '\b(tests|samples|cmd|lib)/[a-z_/-]+\.(cpp|h|sh|txt|py|cases|awk)\b' lib cmd/*.cpp tests/unit tests/bench Makefile tests/targets.mk | sort -u)
exit $wrong
