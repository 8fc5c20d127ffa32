#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A car coasts down both ways in a wind of 2.5 m/s that nobody told: speeds at 1 Hz with a noise of
# 0.05 m/s, from 33 to 5 m/s. The fit finds the wind, f0 = d0 m g/R (150 N) to 0.31 N and the wind to
# 0.011 m/s, which is what the readings hold, and its intervals cover.
set -u
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
export LC_ALL=C
printf '# d0[m]\td2[s^2/m]\n3.058103975535168e-3\t8.154943934760448e-6\n' >"$scratch/car"
records=60
for way in 1 -1; do
  simulate --law "$scratch/car" -K 0.04 -R 0.3 --v0 $((33 * way)) --wind 2.5 --dt 1 --until 160 --columns t,v |
    awk '/^##/ { next } /^#/ || $2 ^ 2 > 25' >"$scratch/true$way"
done
for seed in $(seq $records); do
  for way in 1 -1; do
    awk -v seed="$((2 * seed + way))" 'BEGIN { srand(seed) } /^#/ { print; next }
      { print $1 "\t" $2 + 0.05 * sqrt(-2 * log(1 - rand())) * cos(6.283185307179586 * rand()) }' "$scratch/true$way"
    echo
  done | fitpower -q -K 0.04 -R 0.3 --law d0+d2*v^2 --wind fit | tail -n 1
done | awk -v records="$records" '
  { n++; f0 += $2 * 49050; w += $9; if (($1 - 3.058103975535168e-3)^2 < (1.96 * $2)^2) covered++; if (($8 - 2.5)^2 < (1.96 * $9)^2) covered_w++ }
  END { printf "%d fits: f0 +- %.3f N, covered in %d; wind +- %.4f m/s, covered in %d\n", n, f0 / n, covered, w / n, covered_w
    exit !(n == records && f0 / n < 0.31 && w / n < 0.011 && covered >= 52 && covered_w >= 52) }'
