#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 1 near the stop: the cylinder on rubber rolls backwards before it rests. The law D(v) alone
# cannot show it; a bulge that remembers the last half millimetre does. This length is not fitted:
# it is the one of which the run was made. `make figures/fig1-stop.svg`
. "$(dirname "$0")/draw.sh"
roll() { simulate --law fit -K 0.5 -R 0.04 --columns t,x,v "$@"; }
smooth -q --coast -c x -w 1 CR.csv >roll
fitpower -q --route position -K 0.5 -R 0.04 roll >fit
roll --until 5.6 >law
roll --until 5.6 --dt 0.005 --memory 5e-4 --damping 0.02 >memory
differentiate -q -c x CR.csv >raw
# Times are from the stop that the law alone predicts; positions from the place of rest, for the
# run the mean of its last second.
stop=$(roll | awk 'END { print $1 }')
rest=$(tail -n 25 raw | awk '{ sum += $2 } END { print sum / NR }'
  for file in law memory; do awk 'END { print $2 }' "$file"; done)
title='Fig. 1, the stop: velocity and position near the stop, with the brief roll backwards'
draw 520 680 "stop = $stop; rest = '${rest//$'\n'/ }'" <<'PLOT'
set multiplot layout 2,1 margins 0.15,0.98,0.09,0.98 spacing 0.1
set xrange [-0.52:0.82]; set xzeroaxis lt -1 lw 0.5
set xlabel 'time after the stop that the law D(v) alone predicts / s'
after(t) = t - stop
set ylabel 'velocity v / (mm/s)' offset 0.7, 0; set yrange [-22:110]
plot 'raw' using (after($1)):(1e3*$4) with points ls 1 ps 0.6 \
       title 'C on rubber: differences of the positions', \
     'memory' using (after($1)):(1e3*$3) with lines ls 1 \
       title 'with a memory of 0.5 mm (given, not fitted)', \
     'law' using (after($1)):(1e3*$3) with lines ls 12 title 'fitted law alone'
set ylabel 'distance from rest / mm' offset -1, 0; set yrange [-8:2]; set key bottom right
plot 'raw' using (after($1)):(1e3*($2-word(rest,1))) with points ls 1 ps 0.6 \
       title 'C on rubber: the positions', \
     'memory' using (after($1)):(1e3*($2-word(rest,3))) with lines ls 1 \
       title 'with a memory of 0.5 mm (given, not fitted)', \
     'law' using (after($1)):(1e3*($2-word(rest,2))) with lines ls 12 title 'fitted law alone'
PLOT
