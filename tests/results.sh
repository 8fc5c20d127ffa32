#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# results.sh GOAL...: runs these goals of make, and writes a line for each into tests/results.txt, in place
# of the line of this goal and system: the last line of a suite, the lines and branches that were reached,
# the mutants that were killed and those that lived; for a measurement, that it ended, and how long it took.
# All that a goal said stays in build/results/GOAL.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/.." || exit 2
wrong=0
system=$(. /etc/os-release 2>/dev/null && echo "$PRETTY_NAME" || uname -sr)
system+=", $(uname -m), $(${CXX:-g++} --version | head -n 1)"
# Before the first line, which changes the sources.
mkdir -p build/results
make all >build/results/all 2>&1 || { tail -n 20 build/results/all && exit 2; }
version=$(bin/smooth --version | cut -d ' ' -f 3)
for goal; do
  SECONDS=0
  said=build/results/$goal
  make "$goal" >"$said" 2>&1
  status=$?
  last=$(sed -nE '/^[0-9]+ passed, [0-9]+ failed|^[0-9]+ of [0-9]+ killed|^(lines|branches): /p
    s/^  (survived: )/\1/p' "$said" | paste -s -d ';' | sed 's/;/; /g')
  last=${last:-done in $SECONDS s}
  if [ $status != 0 ]; then
    wrong=1
    grep -A 14 '^FAIL' "$said"
    tail -n 20 "$said"
    last+=" (make: exit status $status)"
  fi
  touch tests/results.txt
  {
    grep -vF "make $goal: $system: " tests/results.txt
    echo "make $goal: $system: $version: $last"
  } | sort >build/results.txt && cp build/results.txt tests/results.txt
done
exit $wrong
