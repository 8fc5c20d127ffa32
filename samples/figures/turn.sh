#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws a ball that rolls up an incline of 2 cm a metre and back: its speed and, below, where its energy
# is. Points: the energy stored at the measured velocities, and the energy that the fitted shift
# dissipates at them. Lines: the same for the fitted trajectory. If the law is right, the sum is constant,
# through the turning point too.
#
#   turn.sh [OPTION]... [FILE] >turn.svg      this ball, or your own run
#
#   --slope S          slope tan(theta) of the mat, above 0 if x grows uphill (fit: found by the fit)
#   --seconds S        window of the parabolas whose slope is the velocity (0.84)
takes='--slope --seconds' seconds=0.84 slope=fit needs='-K 0.4 -R 0.0127 -m 0.067'
. "$(dirname "$0")/draw.sh"
if [ "$own" = 0 ]; then
  K=0.4 R=0.0127 m=0.067 files=("$scratch/ball")
  simulate -K $K -R $R -a 5e-5 -b 0.1 --slope 0.02 --v0 0.5 --sensor pasco --until 6.4 --seed 1 >"${files[0]}"
fi
prepare
balance
title='A roll up a slope and back: its velocity and its energies against time'
draw 520 720 "start = $start; parts = $parts" <<'PLOT'
set multiplot
set lmargin at screen 0.17; set rmargin at screen 0.97
set tmargin at screen 0.98; set bmargin at screen 0.62
set xlabel 'time t / s'; set ylabel 'velocity v / (m/s)' offset 0.5, 0; set xrange [0:*]; set xzeroaxis lt -1 lw 0.5
plot 'fitted' using ($1-start):6 with lines lc rgb black lw 1.5 title 'fitted', \
     'measured' using ($1-start):6 every thin('measured', 40) with points pt 4 ps 0.6 lc rgb black title 'measured'
set tmargin at screen 0.52; set bmargin; set ylabel offset 0.5, 0
load 'energies.gp'
PLOT
