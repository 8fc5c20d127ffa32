#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the suite does not build or run rots. Every source is compiled by `make check`, and every goal
# of tests/targets.mk is run here on the smallest amount, or named with what keeps it from that.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# shim.cpp has no headers of the project, tool.cpp is compiled under the name of each tool.
find build -name '*.d' -exec cat {} + | tr -d '\\:' | tr ' ' '\n' | sort -u >"$scratch/compiled"
while IFS= read -r source; do
  case $source in
    tests/faults/shim.cpp) [ -e build/shim.so ] ;;
    tests/fuzz/tool.cpp) [ -e build/fuzz/smooth-target.o ] ;;
    tests/gcov_exit.cpp) g++ -std=c++20 -fsyntax-only "$source" ;;
    *) grep -qxF "$source" "$scratch/compiled" ;;
  esac || complain "$source is compiled by nobody"
done < <(find cmd lib tests -name '*.cpp')

make -n build/unit-base >"$scratch/said" 2>&1 || complain "build/unit-base: $(cat "$scratch/said")"

# run GOAL: what it prints goes to $scratch/said.
run() {
  make SHORT=1 "$1" >"$scratch/said" 2>&1 ||
    complain "make SHORT=1 $1: $(tail -n 20 "$scratch/said")"
}
has() { grep -qE -- "$2" "$1" || complain "$1 has no '$2': $(head -n 5 "$1")"; }
goals=$(sed -n '/^\.PHONY:/,/[^\\]$/p' tests/targets.mk | tr -d '\\' | sed 's/\.PHONY://')
for goal in $goals; do
  case $goal in
    coverage)
      run coverage
      has build/coverage.txt '^white x +position +CR +[-+]' ;;
    bad-runs)
      run bad-runs
      # A fault that a run shows is never silent; the others are marked. A good run hardly ever fails.
      awk -F '\t' '/^#/ { next } { rows++ } /^none/ { if ($3 + $4 > 1) exit 1; next } $1 !~ / -$/ && $6 > 0 { exit 1 }
        END { if (rows < 15) exit 1 }' build/bad-runs.txt || complain "$(cat build/bad-runs.txt)" ;;
    peers)
      for python in python3 /usr/bin/python3; do
        "$python" -c 'import lmfit' 2>/dev/null || continue
        run peers
        has build/peers.txt '^Rubber1 +1[1-6][.0-9]* / 1[1-6][.0-9]* +[4-9]'
        has build/beside.tsv '^CF.rolling.0[.]00'
        break
      done ;;
    lab-rates)
      run lab-rates
      # One folder does not say whether 1 % is found: a good one passes, from 2 % on a run is named.
      awk -F '\t' '/^#/ { next } { rows++ } $2 == 0 && $4 > 0 || $2 >= 2 && ($4 < $3 || $5 < $3) { exit 1 }
        END { if (rows != 4) exit 1 }' build/lab-rates.txt || complain "$(cat build/lab-rates.txt)" ;;
    extremes)
      python3 -c 'import mpmath' 2>/dev/null || continue
      run extremes
      # Rounding alone; with a memory and near a balance of the slope there is more, and in a bowl a
      # part of the tolerance.
      awk -F '\t' '/^#/ { next } { rows++ } $5 != "" || $4 > 5 { exit 1 }
        $1 !~ /memory|balance|bowl/ && ($2 > 1e-15 || $3 > 1e-15) { exit 1 }
        /bowl/ { split($1, told, "tolerance "); if ($2 > told[2] / 100) exit 1 }
        /held/ && !/not held/ && !/v = 0.0e\+00/ { exit 1 }
        END { if (rows < 8) exit 1 }' build/extremes.txt || complain "$(cat build/extremes.txt)" ;;
    work-precision)
      run work-precision
      awk -F '\t' '$1 == "v" && NF == 2 { found = $2 } END { exit !(found > 0 && found < 1e-13) }' \
        build/work-precision/ulp.tsv || complain "ulp: $(head -n 3 build/work-precision/ulp.tsv)"
      # Nothing is linked that is not called.
      has build/tools.txt $'^smooth\t[^\t]*\t[^\t]*\tlibfmt$'
      has build/tools.txt $'^simulate\t[^\t]*\t[^\t]*\tlibfmt libgsl libgslcblas$'
      # The names of the table are those of its rows, and of the page.
      table=build/work-precision/memory-1e-3.txt
      awk -F '\t' '/^#/ { n = NF } !/^#/ && NF && NF != n { exit 1 }' $table || complain "$table: $(head -n 3 $table)"
      names=$(sed -n '1s/^# //p' $table | tr '\t' ' ')
      has tests/bench/README.md "\`$names\`"
      ! command -v gnuplot >/dev/null ||
        [ "$(grep -c "<path stroke='rgb" "${table%.txt}.svg")" -ge 5 ] || complain "${table%.txt}.svg has no curves" ;;
    work-precision-signal)
      run work-precision-signal
      has build/work-precision/signal.tsv '^CR.savgol' ;;
    # These need minutes, another compiler, another machine, or run this suite.
    results | bench | mutate | lint | fuzz | sanitize | coverage-lines | check-*) ;;
    static-arm64) ;;
    *) complain "the goal $goal is not run here" ;;
  esac
done
exit $wrong
