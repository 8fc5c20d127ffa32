#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The brief roll backwards comes back from a run: its begin, duration, way and speed are, for a memory of
# 1 mm, which is found too, those that an independent solver finds (LSODA, rtol 1e-9); where a body rests at once, or the
# noise is larger, it is said not to be seen. Towards either side it is the same.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# run NOISE SEED SIGN OPTION...: five seconds at 100 Hz with normal noise [m].
run() {
  local noise=$1 seed=$2 sign=$3
  shift 3
  simulate --scene samples/CR.toml --dt 0.01 --until 5 --columns t,x "$@" | awk -F '\t' -v OFS='\t' \
    -v noise="$noise" -v seed="$seed" -v sign="$sign" '
    function uniform() { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
    /^#/ { print; next }
    { print $1, sign * ($2 + noise * sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform())) }' >"$scratch/run"
}
back() { samples/roll-back.sh -K 0.5 -R 0.04 "$scratch/run" 2>"$scratch/err" || complain "roll-back.sh: $(cat "$scratch/err")"; }
runs=2 most=13.8
[ -z "${LONG:-}" ] || runs=12 most=33
for seed in $(seq 10 $((9 + runs))); do
  run 5e-5 $((seed * 7919)) 1 --memory 1e-3
  back
done >"$scratch/seen"
[ "$(grep -c '^begins at' "$scratch/seen")" = $runs ] || complain "not seen: $(cat "$scratch/seen")"
# The sum of the squares of 2 pulls is below 13.8 in 99.9 % of all cases, of 12 below 33.
paste -d ' ' - - <"$scratch/seen" | sed 's/[^-+.0-9 ]//g; s/+-//g' | awk -v most=$most '
  BEGIN { split("2.3722 0.315 1.76 8.98 1", truth, " ") }
  { for (i = 1; i <= 5; i++) squares[i] += (($(2 * i - 1) - truth[i]) / $(2 * i))^2 }
  END { for (i = 1; i <= 5; i++) { printf "%.1f ", squares[i]; bad += squares[i] > most } exit bad > 0 }' >"$scratch/said" ||
  complain "squares of the pulls: $(cat "$scratch/said")" "$(cat "$scratch/seen")"
run 5e-5 1000 1 --memory 1e-3
there=$(back)
run 5e-5 1000 -1 --memory 1e-3
[ "$there" = "$(back)" ] || complain "towards the other side: $there, $(back)"

# Of a body that rests at once one run in a hundred is told to roll back.
seen=0
for seed in $(seq 30 $((29 + runs))); do
  run 5e-5 $((seed * 7919)) 1
  case $(back) in begins*) seen=$((seen + 1)) ;; esac
done
[ $seen -le $((runs / 4)) ] || complain "$seen of $runs bodies that rest are seen to roll back"
run 2e-3 77 1 --memory 1e-3
back | grep -q '^not seen above the noise: of 200 such runs of a body that rests at once' || complain "2 mm of noise: $(back)"

head -n 200 "$scratch/run" >"$scratch/short" && mv "$scratch/short" "$scratch/run"
samples/roll-back.sh -K 0.5 -R 0.04 "$scratch/run" 2>"$scratch/err" && complain 'a run without a stop'
tail -n 1 "$scratch/err" | grep -q '^roll-back.sh: the run ends at the stop' || complain "without a stop: $(cat "$scratch/err")"
samples/roll-back.sh -K 0.5 "$scratch/run" 2>"$scratch/err" && complain 'R is guessed'
grep -qx 'roll-back.sh: say what rolled: -K 0.5 -R 0.04' "$scratch/err" || complain "R: $(cat "$scratch/err")"
exit $wrong
