#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 4: D against v of the free rolls, the fitted laws, and their 95 % bands. For up to four of
# your own runs the key has the laws. The note says by chi2 and p whether several runs agree. For one run
# bars show the scatter of its points. A roll towards falling x is drawn with D and v positive.
#
#   fig4.sh [OPTION]... [FILE]... >fig4.svg      the four experiments, or your own runs
#
#   --slope S          slope tan(theta) of the mat, above 0 if x grows uphill (0); a roll that turns needs it
#   --seconds S        width of the window over which velocities are smoothed (0.44)
takes='--slope --seconds' seconds=0.44
. "$(dirname "$0")/draw.sh"
prepare CR SR CF SF

# D against v of each roll, one under another; the picture has the rows of whole windows alone,
# fitpower knows the noise of all of them.
for i in $(seq "$count"); do
  body "$i"
  if [ $column = x ]; then differentiate -q -c x "roll$i"; else cat "roll$i"; fi |
    smooth -q -c v --seconds "$seconds" | differentiate -q -c v |
    shift-from-accel ${quiet:+-q} "${body[@]}" >"shift$i"
  [ "$i" = 1 ] || echo
  cat "shift$i"
done >shifts
fit shifts
for i in $(seq "$count"); do
  whole_windows <"shift$i" >whole
  columns whole v D | awk -F '\t' '
    { if (!n) way = $1 < 0 ? -1 : 1
      v[++n] = way * $1; D[n] = way * 1e3 * $2
      if (v[n] < back) back = v[n]
      if (v[n] > on) on = v[n] }
    END {  # of a roll that turns, the way back too
      for (i = 1; i <= n; i++) {
        sign = v[i] < 0 && back < -0.1 * on ? -1 : 1
        printf "%.17g\t%.6g\n", sign * v[i], sign * D[i]
      } }' >"points$i"
  law_of "fit$i" >"law$i"
done
frame='vmax = 0.5; Dmin = 0; Dmax = 2.2'
[ "$own" = 0 ] || frame=$(cat points[0-9]* | awk '
  { if ($1 > v) v = $1; if ($2 > D) D = $2; if ($2 < low) low = $2 }
  END { printf "vmax = %g; Dmin = %g; Dmax = %g", 1.05 * v, 1.1 * low, 1.35 * D }')
vmax=${frame%%;*}
for i in $(seq "$count"); do
  "$samples/law.sh" -f "$(awk "BEGIN { $frame; print 0.04 * vmax }")" -t "${vmax#*= }" -n 200 "fit$i" >"band$i"
done
# The scatter of the points about the law, for their bars.
scatter=$(awk '
  /^#/ { next }
  FNR == NR { v[++n] = $1; D[n] = 1e3 * $2; next }
  { i = int(($1 - v[1]) / (v[2] - v[1])) + 1 }
  i >= 1 && i < n { sum += ($2 - D[i] - (D[i + 1] - D[i]) * ($1 - v[i]) / (v[i + 1] - v[i]))^2; rows++ }
  END { print (rows ? sqrt(sum / rows) : 0) }' band1 points1)
bars=0
[ "$own$count" != 11 ] || [ "$(wc -l <points1)" -gt 150 ] || bars=1
# What holds for all of the picture, below it.
{
  if [ $bars = 1 ]; then printf 'Band: 95 %% confidence of the law. Bars: scatter, ± %.3g mm.\n' "$scatter"
  else echo 'Bands: 95 % confidence of the law, not of the points.'; fi
  printf 'Points: the free roll, less half a window of %s s at each end.\n' "$seconds"
  if [ "$own" -gt 0 ]; then
    printf 'K = %s, R = %s m' "${K//+-/ ± }" "${R//+-/ ± }"
    [ "$slope" = 0 ] || printf ', slope %s' "$slope"
    [ "$law" ] || [ "$count" -gt 4 ] || printf '; a is D at 1 m/s'
    # Whether runs of one law a v^b agree.
    [ "$count" = 1 ] || [ "$law" ] || fitpower -q --route fits --digits 3 fits | columns - chi2 dof p |
      awk -F '\t' 'NF == 3 { printf "; χ²/dof = %s/%s, p = %.2g", $1, $2, $3 }' || true
    [ "$count" -le 16 ] || printf '; the key names the first 16 of %s runs' "$count"
    echo
  fi
} >note
title='Fig. 4: the shift D against the velocity, with the fitted laws and their 95 % bands'
draw 520 540 "$frame; scatter = $scatter; bars = $bars" <<'PLOT'
array least[count]; array most[count]
do for [i = 1:count] {
  stats sprintf('points%d', i) using 1 nooutput
  least[i] = STATS_min; most[i] = STATS_max
}
set bmargin at screen 0.225; set tmargin at screen 0.98
set xlabel 'velocity v / (m/s)'; set ylabel 'shift D / mm'
set label 1 system('cat note') at screen 0.02, screen 0.085 left font ',12' noenhanced
set xrange [0:vmax]; set yrange [Dmin:Dmax]; if (Dmin < 0) { set xzeroaxis lt -1 lw 0.5 }
set style fill transparent solid 0.2 noborder
set key top left width 2
if (own) { set key maxrows 4 } else { set key maxrows 2 }
told = own && count <= 4   # the key has the laws
# The key has four columns of four names. What does not fit gnuplot leaves out without a word, so
# long names lose their middle: of a line of small letters each column takes 8 for its symbol.
room = 34
if (told) { room = 14; set key Left reverse width 0 font ',11' samplen 1.5 }
if (named > 4) { set key font ',11' samplen 2.6; room = 50/((named + 3)/4) - 8 }
array title[count]
do for [i = 1:count] {
  title[i] = cut(name(i), room).(told ? ':  '.system(sprintf('cat law%d', i)) : '')
}
if (!own) { set label 'rubber' at 0.495, 1.74 right; set label 'felt' at 0.495, 0.77 right }
file(name, i) = sprintf('%s%d', name, i)
inside(i, v) = v >= least[i] && v <= most[i] ? v : NaN
outside(i, v) = v >= least[i] && v <= most[i] ? NaN : v
# The law is a full line where there are points, a dotted one elsewhere.
plot for [i=1:count] file('band', i) using 1:(1e3*$5):(1e3*$6) with filledcurves ls line(i) notitle, \
     for [i=1:count] file('points', i) using 1:2 every thin(file('points', i), 300) \
       with points ls line(i) notitle, \
     for [i=1:count] file('band', i) using (outside(i, $1)):(1e3*$2) with lines ls line(i) dt 3 \
       notitle, \
     for [i=1:count] file('band', i) using (inside(i, $1)):(1e3*$2) with lines ls line(i) notitle, \
     for [i=1:bars] file('points', i) using 1:($2 - scatter):(0):(2*scatter) \
       with vectors nohead ls line(i) lw 0.5 notitle, \
     for [i=1:named] keyentry with linespoints ls line(i) ps 0.9 title title[i] noenhanced
PLOT
