#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 1, v(t) of the four experiments: differences of the sensor's positions, the same smoothed,
# and the trajectory that fits the positions, both of the free roll. `make figures/fig1.svg`, or
# samples/figures/fig1.sh >fig1.svg
. "$(dirname "$0")/draw.sh"
run() {  # NAME K
  differentiate -q -c x "$1.csv" >"$1.raw"
  smooth -q --coast -c x -w 1 "$1.csv" >"$1.roll"
  differentiate -c x "$1.roll" | smooth -w 11 | whole_windows >"$1.v"
  fitpower -q --route position -K "$2" -R 0.04 "$1.roll" |
    simulate --law - -K "$2" -R 0.04 --columns t,v >"$1.line"
}
run CR 0.5; run SR 0.83; run CF 0.5; run SF 0.83
title='Fig. 1: the velocity of the four experiments against time'
draw 520 680 <<'PLOT'
set multiplot layout 2,1 margins 0.14,0.98,0.09,0.98 spacing 0.1
set xrange [0.8:9.2]; set yrange [-0.05:0.55]; set xzeroaxis lt -1 lw 0.5
set ylabel 'velocity v / (m/s)'; set xlabel 'time t / s'
of(i, kind) = word(runs, i) . kind
do for [mat = 0:1] {
  plot for [i = 2*mat+1:2*mat+2] of(i, '.raw') using 1:4 with points pt 7 ps 0.3 lc rgb grey \
         notitle, \
       for [i = 2*mat+1:2*mat+2] of(i, '.v') using 1:4 every 2 with points ls i ps 0.6 notitle, \
       for [i = 2*mat+1:2*mat+2] of(i, '.line') with lines ls 10+i notitle, \
       for [i = 2*mat+1:2*mat+2] keyentry with points ls i ps 0.8 title label[i], \
       for [i = 2*mat+1:2*mat+2] keyentry with lines ls 10+i title body[i].', fitted trajectory', \
       keyentry with points pt 7 ps 0.3 lc rgb grey title 'before smoothing'
}
PLOT
