#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Where the energy of the cylinder on rubber goes: points, what its measured velocities store and
# what the fitted shift dissipates at them; lines, the same for the fitted trajectory. The sum has
# to stay. `make figures/energy.svg`
. "$(dirname "$0")/draw.sh"
smooth -q --coast -c x -w 1 CR.csv >roll
fitpower -q --route position -K 0.5 -R 0.04 roll >fit
ledger() { energy-ledger -m 1.375 -K 0.5 -R 0.04 --law fit; }
differentiate -c x -M savgol -w 21 roll | ledger >measured
start=$(awk '!/^#/ { print $1; exit }' roll)
simulate --law fit -K 0.5 -R 0.04 --columns t,v | ledger >fitted
title='Energy of the cylinder on rubber against time: translation, rotation, dissipated, and their sum'
draw 520 480 "start = $start" <<'PLOT'
set xlabel 'time t / s'; set ylabel 'energy / J'; set yrange [0:0.24]; set xrange [0:2.3]
set key at graph 0.98, 0.6
set style line 1 lc rgb purple lw 2 dt 1 pt 7; set style line 2 lc rgb blue lw 2 dt 2 pt 2
set style line 3 lc rgb vermilion lw 2 dt 4 pt 9; set style line 4 lc rgb black lw 2 dt 1 pt 4
array what[4] = ['translational', 'rotational', 'dissipated', 'sum']
# f is the field of E_trans; the measured run has two more columns before it, x and the velocity
# of the sensor.
energy(i, f) = i == 1 ? column(f) : i == 2 ? column(f + 1) : i == 3 ? column(f + 9) : \
               column(f) + column(f + 1) + column(f + 9)
plot for [i=1:4] 'fitted' using ($1-start):(energy(i, 3)) with lines ls i notitle, \
     for [i=1:4] 'measured' using ($1-start):(energy(i, 5)) every 2 with points ls i ps 0.7 \
       notitle, \
     for [i=1:4] keyentry with linespoints ls i ps 0.7 title what[i], \
     keyentry with points ls 4 ps 0.7 title 'points: measured velocities', \
     keyentry with lines ls 4 title 'lines: fitted trajectory'
PLOT
