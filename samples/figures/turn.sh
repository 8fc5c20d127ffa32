#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A ball that is sent up an incline of 2 cm a metre, turns and comes back: its speed and, below,
# where its energy is. Points, what its measured velocities store and what the fitted shift
# dissipates at them; lines, the same for the fitted trajectory. The sum has to stay, through the
# turning point too. `make figures/turn.svg`
. "$(dirname "$0")/draw.sh"
ball() { "$@" -K 0.4 -R 0.0127; }
ball simulate -a 5e-5 -b 0.1 --slope 0.02 --v0 0.5 --sensor pasco --until 6.4 --seed 1 |
  smooth -q --coast -c x >roll
ball fitpower -q --slope fit roll >fit
ledger() { ball energy-ledger -m 0.067 --law fit --columns E_trans,E_rot,E_diss,W_g; }
differentiate -q -c x -M savgol -w 21 roll | ledger >measured
ball simulate --law fit --at roll --columns t,v | ledger >fitted
start=$(awk '!/^#/ { print $1; exit }' roll)
title='A ball on an incline: up, turning point and back, its velocity and its energies against time'
draw 520 680 "start = $start" <<'PLOT'
set multiplot layout 2,1 margins 0.14,0.98,0.09,0.98 spacing 0.1
set style line 1 lc rgb purple lw 2 dt 1 pt 7; set style line 2 lc rgb blue lw 2 dt 2 pt 2
set style line 3 lc rgb vermilion lw 2 dt 4 pt 9; set style line 4 lc rgb green lw 2 dt 5 pt 5
set style line 5 lc rgb black lw 2 dt 1 pt 4
set xrange [0:6.5]; set xlabel 'time t / s'
set ylabel 'velocity v / (m/s)'; set xzeroaxis lt -1 lw 0.5
plot 'fitted' using ($1-start):2 with lines lc rgb black lw 1.5 notitle, \
     'measured' using ($1-start):3 every 3 with points ls 5 ps 0.6 notitle, \
     keyentry with points ls 5 ps 0.6 title 'measured', keyentry with lines lc rgb black lw 1.5 title 'fitted'
set ylabel 'energy / mJ'; set yrange [0:15]; set key at graph 0.99, 0.99 maxrows 3
array what[5] = ['translational', 'rotational', 'dissipated', 'lifted', 'sum']
# f is the field of E_trans.
energy(i, f) = 1000 * (i < 5 ? column(f + i - 1) : \
                       column(f) + column(f + 1) + column(f + 2) + column(f + 3))
plot for [i=1:5] 'fitted' using ($1-start):(energy(i, 3)) with lines ls i notitle, \
     for [i=1:5] 'measured' using ($1-start):(energy(i, 5)) every 3 with points ls i ps 0.6 notitle, \
     for [i=1:5] keyentry with linespoints ls i ps 0.6 title what[i]
PLOT
