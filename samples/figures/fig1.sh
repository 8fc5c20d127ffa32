#!/bin/bash
# Fig. 1, v(t) of the four experiments: points of the sensor's positions, lines of the fitted trajectories. `make figures/fig1.svg`
# Run in samples/ with the tools on PATH; writes gnuplot's output for the terminal in $1 (svg or pngcairo) to standard output.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fit() {  # NAME K: the free roll's velocities, and the trajectory that fits its positions, from the first of them on
  smooth -q --coast -c x -w 1 "$1.csv" >"$scratch/$1.roll"
  awk -F, '$2 != "" && FNR > 1 { print $1, $2 }' "$1.csv" | differentiate --use x=2 -c x >"$scratch/$1.v"
  fitpower -q --route position -K "$2" -R 0.04 "$scratch/$1.roll" >"$scratch/$1.fit"
  local start
  start=$(awk '!/^#/ { print $1; exit }' "$scratch/$1.roll")
  simulate --law "$scratch/$1.fit" -K "$2" -R 0.04 --columns t,v | awk -v start="$start" '!/^#/ { print $1 + start, $2 }' >"$scratch/$1.line"
}
fit CR 0.5; fit SR 0.83; fit CF 0.5; fit SF 0.83
cd figures
gnuplot -e "scratch = '$scratch'; set terminal $1 size 800,500 font 'sans,12'" - <<'PLOT'
load 'style.gp'
set xlabel 'time t / s'; set ylabel 'velocity v / (m/s)'
set yrange [-0.05:0.6]; set xzeroaxis lt -1 lw 0.5
plot for [i=1:4] sprintf('%s/%s.v', scratch, word('CR SR CF SF', i)) using 1:3 with points ls i \
       title word('"C on rubber" "S on rubber" "C on felt" "S on felt"', i), \
     for [i=1:4] sprintf('%s/%s.line', scratch, word('CR SR CF SF', i)) with lines ls i notitle
PLOT
