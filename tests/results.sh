#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# results.sh GOAL...: runs these goals of make, and writes a line for each into tests/results.txt, in place
# of the line of this goal and system: the last line of a suite, the lines and branches that were reached,
# the mutants that were killed and those that lived; for a measurement, that it ended, and how long it took.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/.." || exit 2
wrong=0
system=$(. /etc/os-release 2>/dev/null && echo "$PRETTY_NAME" || uname -sr)
system+=", $(uname -m), $(${CXX:-g++} --version | head -n 1)"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
# Before the first line, which changes the sources.
make all >"$scratch/said" 2>&1 || { tail -n 20 "$scratch/said" && exit 2; }
version=$(bin/smooth --version | cut -d ' ' -f 3)
for goal; do
  SECONDS=0
  make "$goal" >"$scratch/said" 2>&1
  status=$?
  last=$(sed -nE '/^[0-9]+ passed, [0-9]+ failed|^[0-9]+ of [0-9]+ killed|^(lines|branches): /p
    s/^  (survived: )/\1/p' "$scratch/said" | paste -s -d ';' | sed 's/;/; /g')
  last=${last:-done in $SECONDS s}
  [ $status = 0 ] || { wrong=1; grep -A 14 '^FAIL' "$scratch/said"; tail -n 20 "$scratch/said"; last+=" (make: exit status $status)"; }
  touch tests/results.txt
  {
    grep -vF "make $goal: $system: " tests/results.txt
    echo "make $goal: $system: $version: $last"
  } | sort >"$scratch/results" && cp "$scratch/results" tests/results.txt
done
exit $wrong
