#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws the residuals of a fit against time and against velocity: the first look at whether a law
# describes a run. The fit is to the positions of the free roll; with -c v, or without positions, to the
# velocities. Below the picture stand, for up to three runs, the law, the rms of the fit, the scatter (from
# the median of |residual|), the number of rows left out, and the times of rows that are off by more than
# five times the scatter. A roll towards falling x is drawn with the signs turned.
#
#   residuals.sh [OPTION]... [FILE]... >residuals.svg      the cylinder on rubber, or your own runs
#
#   --slope S          slope tan(theta) of the mat, above 0 if x grows uphill (0)
#   --by N             use the law of run number N for all runs, with its 95 % limits; v0 and x0 are those
#                      of each run
takes='--slope --by' by=''
. "$(dirname "$0")/draw.sh"
prepare CR
fit --route $route rolls
unit=mm && [ $column = x ] || unit=mm/s
separate readings readings
: >note
: >outliers
[ -z "$by" ] || { is_count "$by" && [ "$by" -ge 1 ] && [ "$by" -le "$count" ]; } ||
  wrong "--by $by: a run from 1 to $count"
[ -z "$by" ] || [ -z "$law" ] || wrong '--by is for the law a v^b'
for i in $(seq "$count"); do
  body "$i"
  # The roll of the row, from its t0, v0 and x0 on, at the times of the run.
  roll=(--law "fit$i" --columns "x,v") sigma=()
  if [ "$by" ]; then
    fitpower -q "${body[@]}" --route $route --fix a="$(columns "fit$by" a)" --fix b="$(columns "fit$by" b)" "roll$i" >own
    roll=(--law "fit$by" --columns "x,v,sigma_$column" --t0 "$(columns own t0)" --v0 "$(columns own v0)")
    [ $column = v ] || roll+=(--x0 "$(columns own x0)")
    sigma=("sigma_$column")
  fi
  simulate ${quiet:+-q} "${roll[@]}" "${body[@]}" --at "roll$i" >law
  columns law $column v ${sigma[@]+"${sigma[@]}"} >"law$i"
  columns "roll$i" t $column | paste - "law$i" | awk -F '\t' 'NR == 1 { way = $4 < 0 ? -1 : 1 }
    { printf "%s\t%.9g\t%.9g\t%.9g\n", $1, ($4 < 0 ? -$4 : $4), 1e3 * way * ($2 - $3), 1960 * $5 }' >"residuals$i"
  # The scatter is the median of |residual|, over 0.6745 that of a normal one.
  scatter=$(awk '{ print ($3 < 0 ? -$3 : $3) }' "residuals$i" | sort -g |
    awk '{ r[NR] = $1 } END { print (r[int((NR + 1) / 2)] + r[int(NR / 2) + 1]) / 2 / 0.6745 }')
  awk -v scatter="$scatter" '{ r = $3 < 0 ? -$3 : $3 } r > 5 * scatter' "residuals$i" >off
  cat off >>outliers
  if [ "$i" = 4 ]; then echo "… $count runs in all" >>note; fi
  [ "$i" -lt 4 ] || continue
  {
    name=$(sed -n "${i}p" names): && [ ${#name} -lt 32 ] || name+=$'\n  '
    printf '%s  %s\n' "$name" "$(law_of "fit$i")"
    awk -v unit=$unit -v rms="$(columns "fit$i" rms)" -v scatter="$scatter" -v rows="$(wc -l <"residuals$i")" \
      -v readings="$(grep -c '^[^#]' "readings$i")" -v outliers="$(wc -l <off)" 'BEGIN {
        printf "   rms %.3g %s, scatter %.3g %s;  %d of %d rows;  %s\n", 1e3 * rms, unit, scatter, unit,
          rows, readings, (outliers == 0 ? "no outlier" : outliers == 1 ? "1 outlier" : outliers " outliers") }'
  } >>note
done
[ -z "$by" ] || printf 'dotted: 95 %% limits of the law of run %s\n' "$by" >>note
printf 'K = %s,  R = %s m' "${K//+-/ ± }" "${R//+-/ ± }" >>note
[ "$slope" = 0 ] || printf ',  slope %s' "${slope//+-/ ± }" >>note
lines=$(($(wc -l <note) + 1))
columns readings t >moments
title='Residuals of a fit against time and against velocity'
above=0
[ "$count" = 1 ] || above=$((20 * (((count < 16 ? count : 16) + 1) / 2)))
draw 520 $((612 + 18 * lines + above)) "lines = $lines; unit = '$unit'; by = 0$by; rms = 1e3*$(columns fit1 rms); outliers = $(wc -l <outliers)" <<'PLOT'
above = count > 1 ? 20*((named + 1)/2) : 0; height = 612.0 + 18*lines + above
below = (18*lines + 10)/height
set multiplot layout 2,1 margins 0.16,0.955,below + 64/height,1 - (10 + above)/height spacing 0.11
set label 1 system('cat note') at screen 0.02, screen below - 8/height left font ',12' noenhanced
file(name, i) = sprintf('%s%d', name, i)
most = 2.5*rms
do for [i=1:count] {
  stats file('residuals', i) using 3 nooutput
  most = max(most, 1.25*max(STATS_max, -STATS_min))
  stats file('residuals', i) using 4 nooutput
  most = max(most, 1.1*STATS_max)
}
stats 'residuals1' using 1 nooutput; first = STATS_min; last = STATS_max
stats 'moments' using 1 nooutput
set ylabel 'residual / '.(unit eq 'mm' ? unit : '('.unit.')') offset 0, 0; set yrange [-most:most]; set xzeroaxis lt -1 lw 0.5
instant(t) = sprintf('t = %s s', t)
marks(x) = outliers == 0 ? '' : \
  sprintf(", 'outliers' using %d:3 with points pt 6 ps 1.2 lw 1.5 lc rgb black notitle", x). \
  sprintf(", 'outliers' using %d:3:(instant(strcol(1))) with labels offset 0, 0.9 font ',11' notitle", x)
# Rows that were left out are shaded; of several runs there is no telling.
if (count == 1) {
  set arrow 1 from graph 0, first rms to graph 1, first rms nohead dt 2 lc rgb grey
  set arrow 2 from graph 0, first -rms to graph 1, first -rms nohead dt 2 lc rgb grey
  set label 2 'rms' at graph 1, first rms right offset 0, 0.5 textcolor rgb 0x606060 font ',12'
  margin = 0.12*(last - first)
  set xrange [first - margin:last + margin]
  if (STATS_min < first) {
    set object 1 rectangle from graph 0, 0 to first first - 0.1*margin, graph 1 fc rgb pale fs solid noborder
    set label 3 "left\nout" at graph 0.01, 0.12 left font ',12'
  }
  if (STATS_max > last) {
    set object 2 rectangle from first last + 0.1*margin, graph 0 to graph 1, 1 fc rgb pale fs solid noborder
    set label 4 "left\nout" at graph 0.99, 0.12 right font ',12'
  }
  set key off
} else { eval 'set key outside top center '.outside }
set xlabel 'time t / s'
limits(sign) = by == 0 ? '' : \
  sprintf("for [i=1:count] file('residuals', i) using 1:(%d*$4) with lines ls line(i) dt 3 notitle, ", sign)
eval "plot ".limits(1).limits(-1)."for [i=1:count] file('residuals', i) using 1:3 with points ls line(i) notitle, ". \
  "for [i=1:named] keyentry with points ls line(i) title name(i) noenhanced".marks(1)
unset object; unset label 3; unset label 4; unset label 1
set xlabel 'velocity v / (m/s)'; set xrange [0:*]; set key off
eval "plot for [i=1:count] file('residuals', i) using 2:3 with points ls (count == 1 ? 3 : line(i)) notitle".marks(2)
PLOT
