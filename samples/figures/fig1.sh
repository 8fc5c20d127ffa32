#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 1, v(t): the differences of the positions, and of the free roll the differences smoothed
# over a window and the trajectory that fits the positions. A roll towards falling x is drawn with v
# positive.
#
#   fig1.sh [OPTION]... [FILE]... >fig1.svg      the four experiments, or your own runs
#
#   --slope S          slope tan(theta) of the mat, above 0 if x grows uphill (0)
#   --seconds S        width of the window (0.44)
takes='--slope --seconds' seconds=0.44
. "$(dirname "$0")/draw.sh"
prepare CR SR CF SF
fit --route $route rolls
velocities() { if [ "$column" = x ]; then differentiate -q -c x "$@"; else cat "$@"; fi; }
forwards() { columns "$1" t v | awk -v OFS='\t' -v way="$way" '{ print $1, way * $2 }'; }
separate readings readings
for i in $(seq "$count"); do
  body "$i"
  case $(columns "fit$i" v0) in -*) way=-1 ;; *) way=1 ;; esac
  velocities "readings$i" >moving && forwards moving >"raw$i"
  velocities "roll$i" | smooth -q -c v --seconds "$seconds" | whole_windows >smoothed
  forwards smoothed >"v$i"
  simulate --law "fit$i" "${body[@]}" --at "roll$i" --columns t,v >moving && forwards moving >"line$i"
done
title='Fig. 1: the velocity against time, measured and by the fitted law'
[ "$own" = 0 ] || key=$((((count < 16 ? count : 16) + 3) / 2))
draw 520 $((own ? 440 + 20 * key : 680)) <<'PLOT'
set xzeroaxis lt -1 lw 0.5
set ylabel 'velocity v / (m/s)' offset -0.5, 0; set xlabel 'time t / s'
panels = own ? 1 : 2
rows = (named + 3)/2; H = 440.0 + 20*rows
set multiplot layout panels,1 margins 0.16,0.97,own ? (62 + 20*rows)/H : 0.09,0.98 spacing 0.1
if (own) { eval 'set key outside center bottom '.outside }
if (!own) { set xrange [0.8:9.2]; set yrange [-0.05:0.55] }
of(kind, i) = sprintf('%s%d', kind, i)
do for [panel = 1:panels] {
  first = own ? 1 : 2*panel - 1; last = own ? count : 2*panel
  plot for [i = first:last] of('raw', i) using 1:2 with points pt 7 ps 0.3 lc rgb grey notitle, \
       for [i = first:last] of('v', i) using 1:2 every thin(of('v', i), 40) with points ls line(i) ps 0.6 notitle, \
       for [i = first:last] of('line', i) with lines ls (own ? 11 : 10 + i) notitle, \
       for [i = first:min(last, first + named - 1)] keyentry with points ls line(i) ps 0.8 title name(i) noenhanced, \
       keyentry with lines ls 11 title 'fitted trajectory', \
       keyentry with points pt 7 ps 0.3 lc rgb grey title 'before smoothing'
}
PLOT
