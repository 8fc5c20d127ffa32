#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# bad-runs.sh [SEEDS]: what `fitpower --check` says of runs with one thing wrong, and of good ones. A
# row for each kind of fault, of SEEDS simulated runs (40) of rubber and felt in turn:
#
#   check     exit 1: the check fails
#   refused   exit 2: there is no row
#   message   exit 0, with a warning
#   silent    exit 0, without a word
#
# What no single run can show is marked `-`: the law is then off, and nothing can tell. Good runs, of which
# there are five times as many, go through five pipelines: each check that fails is a false alarm.
set -euo pipefail
export LC_ALL=C
unset CDPATH
seeds=${1:-40}
cd "$(dirname "$0")/../../samples"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The raw run of a sensor.
raw() { simulate --scene "$scene" --memory 5e-4 --damping 0.02 --sensor pasco --seed "$seed"; }
coast() { smooth -q --coast -c x "$@"; }
fit() { fitpower --check --route position -K "$K" -R 0.04 "$@"; }
# A roll under a law, as an even sensor sees it: noise of 0.3 mm, by Park and Miller's generator and
# Box and Muller.
seen() {
  awk -v seed="$((seed * 7919))" '
    function uniform() { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
    BEGIN { uniform() }
    /^#/ || NF < 2 { print; next }
    { $2 += 3e-4 * sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()); print }' OFS='\t'
}
roll() { simulate --scene "$scene" --columns t,x --dt 0.04 "$@" | seen; }

good() { raw | coast | fit; }
of_speeds() { fitpower --check --route velocity -K "$K" -R 0.04; }
good_speeds() { raw | smooth -q --coast -c v | of_speeds; }
good_differences() { raw | coast | differentiate -q -c x | of_speeds; }
good_shifts() {
  raw | coast | differentiate -q -c x | smooth -q -w 11 | differentiate -q |
    shift-from-accel -K "$K" -R 0.04 | fitpower --check
}
good_four() {
  local all=() i
  for i in 1 2 3 4; do
    simulate --scene "$scene" --sensor pasco --seed "$((10000 * i + seed))" | coast >"$scratch/run$i"
    all+=("$scratch/run$i")
  done
  fit "${all[@]}"
}
millimetres() { raw | coast | awk -F '\t' '/^##/ { print; next } /^#/ { print "# t[s]\tx"; next }
  { print $1 "\t" 1000 * $2 }' | fit; }
other_column() { raw | coast --use x=3 2>/dev/null | fit --use x=3; }
other_K() { raw | coast | fitpower --check --route position -K 0.83 -R 0.04; }
other_R() { raw | coast | fitpower --check --route position -K "$K" -R 0.05; }
push_left_in() { raw | smooth -q -c x -w 1 --from 1.2 --to 3.4 | fit; }
# From 1.2 s on a hand takes the speed away within 0.4 s.
hand_left_in() {
  roll --until 1.6 | awk '/^#/ { print; next }
    $1 > 1.2 { way += ($2 - last) * (1.6 - $1) / 0.4; print $1 "\t" from + way; last = $2; next }
    { print; from = last = $2 }' OFS='\t' | fit
}
two_rolls() { { roll --until 1; roll --until 1 | awk '!/^#/ { print $1 + 1.04 "\t" $2 + 0.4 }'; } | fit; }
tilt() { roll --slope 0.005 | fit; }
tilt_both_ways() {
  { roll --slope 0.002; echo; simulate --scene "$scene" --v0 -0.5 --slope 0.002 --columns t,x --dt 0.04 | seen; } | fit
}
copied() { raw | coast >"$scratch/one"; fit "$scratch/one" "$scratch/one"; }
up_and_back() { simulate -K 0.4 -R 0.0127 -a 5e-5 -b 0.1 --v0 0.5 --slope 0.02 --until 6 --dt 0.04 --columns t,x | seen |
  fitpower --check -K 0.4 -R 0.0127; }
one_of_five() {
  local a=1.87e-3 i
  for i in 1 2 3 4 5; do
    [ $i != 3 ] || a=2.06e-3
    simulate -K 0.5 -R 0.04 -a $a -b 0.215 --v0 0.5 --sensor pasco --seed "$((1000 * i + seed))" |
      smooth -q --coast -c x >"$scratch/run$i"
    a=1.87e-3
  done
  fitpower --check -K 0.5 -R 0.04 "$scratch"/run[1-5]
}
dropped_frames() {
  roll | awk '/^#/ { print; next } ++n % 23 { printf "%.9g\t%s\n", 0.04 * k++, $2 }' | fit
}
K_of_two_bodies_exchanged() {
  simulate --scene CR.toml --sensor pasco --seed "$seed" | coast >"$scratch/C"
  simulate --scene SR.toml --sensor pasco --seed "$seed" | coast >"$scratch/S"
  fitpower --check -K 0.83,0.5 -R 0.04 "$scratch/C" "$scratch/S"
}
# A car in a wind of 2 m/s along the road, which the fit does not know.
coast_down() {  # SPEED
  printf '# d0[m]\td2[s^2/m]\n3e-3\t8.1e-6\n' |
    simulate --law - -K 0.04 -R 0.3 --v0 "$1" --wind 2 --dt 0.5 --until 60 --columns t,v | awk -v OFS='\t' -v seed="$((seed * 7919))" '
      function uniform() { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
      BEGIN { uniform() }
      /^##/ { next }
      !/^#/ { $2 += 0.1 * (uniform() - uniform()) }
      { print }'
}
of_car() { fitpower --check --route velocity --law 'd0+d2*v^2' -K 0.04 -R 0.3; }
wind() { coast_down 25 | of_car; }
wind_both_ways() { { coast_down 25; echo; coast_down -25; } | of_car; }

row() {  # KIND FUNCTION [TIMES]
  local count=(0 0 0) silent=0 status runs=$((seeds * ${3:-1}))
  for ((seed = 1; seed <= runs; seed++)); do
    if ((seed % 2)); then scene=CR.toml; else scene=CF.toml; fi
    K=0.5 status=0
    "$2" >"$scratch/row" 2>"$scratch/said" || status=$?
    ((status < 3)) || { cat "$scratch/said" >&2 && exit 2; }
    count[status]=$((count[status] + 1))
    [ $status != 0 ] || [ -s "$scratch/said" ] || silent=$((silent + 1))
  done
  printf '%s\t%d\t%d\t%d\t%d\t%d\n' "$1" "$runs" "${count[1]}" "${count[2]}" $((count[0] - silent)) $silent
}
printf '# fault\truns\tcheck\trefused\tmessage\tsilent\n'
row 'none, positions' good 5
row 'none, speeds of the sensor' good_speeds 5
row 'none, speeds by differentiate' good_differences 5
row 'none, D' good_shifts 5
row 'none, four runs as one' good_four 5
row 'positions in mm, no unit' millimetres
row 'speeds taken for positions' other_column
row 'push left in' push_left_in
row 'hand left in at the end' hand_left_in
row 'two rolls as one' two_rolls
row 'one run twice' copied
row 'up a slope and back, no slope' up_and_back
row '10 % more D in one of five' one_of_five
row 'one frame in 23 dropped' dropped_frames
row 'K of two bodies exchanged' K_of_two_bodies_exchanged
row 'tilt of 2 mm/m, both ways' tilt_both_ways
row 'wind of 2 m/s, both ways' wind_both_ways
row 'tilt of 5 mm/m, one way -' tilt
row 'wind of 2 m/s, one way -' wind
row 'K of another body -' other_K
row 'R of another body -' other_R
