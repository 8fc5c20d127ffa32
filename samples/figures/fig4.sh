#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 4: D against v, the power law fitted to it, and the 95 % band of the law.
#
#   fig4.sh [-t svg | pngcairo] >fig4.svg         the four experiments
#   fig4.sh [-t ...] -K K[,K...] -R R[,R...] [--slope S] [-c x|v] [--use NAME=COLUMN]... FILE... >mine.svg
#                                                 runs of your own
#
# K is the shape factor, R the radius in metres; each is one for all files or one for each, and may have
# an uncertainty, 0.5+-0.005. S is how the mat rises, in metres a metre along growing x (0); a roll that
# turns needs it. A file has the columns t and x (Time, Position), or t and v (Time, Velocity); of one
# with both -c v takes v. Of each run the free roll is taken; of one towards falling x the signs are
# turned. Up to four runs of your own have their a and b in the picture, and one by itself the scatter
# of its points as bars. `make figures/fig4.svg` draws the experiments.
. "$(dirname "$0")/draw.sh"

# D against v of run $1, the file $3, with the shape factor $2 and the radius $4, and the row of the
# law.
shifts() {
  if [ "$column" = x ] || { [ -z "$column" ] && read_run x -w 1 "$3" >/dev/null 2>&1; }; then
    read_run x --coast -w 1 "$3" | differentiate -c x | smooth -q -w 11
  else
    read_run v --coast -w 11 "$3"
  fi | differentiate -c v | shift-from-accel -q -K "$2" -R "$4" --slope "$slope" >"shift$1"
  fitpower -q "shift$1" >"fit$1"
  # The picture has the rows of whole windows alone; fitpower knows the noise of all of them.
  whole_windows <"shift$1" | awk -F'\t' '
    /^# / { for (i = 1; i <= NF; i++) { if ($i ~ /^v\[/) v = i; if ($i ~ /^D\[/) D = i } next }
    /^[^#]/ { if (!n) way = $v < 0 ? -1 : 1
      speed[++n] = way * $v; shift[n] = way * 1e3 * $D
      if (speed[n] < back) back = speed[n]; if (speed[n] > on) on = speed[n] }
    END {  # of a roll that turns, the way back too
      for (i = 1; i <= n; i++) {
        sign = speed[i] < 0 && back < -0.1 * on ? -1 : 1
        printf "%.17g\t%.6g\n", sign * speed[i], sign * shift[i]
      } }' >"points$1"
  # The law and the scatter of these points about it [mm], as gnuplot reads them.
  { assignments <"fit$1" && awk -F'\t' '
      FNR == NR { if (!/^#/) { a = 1e3 * $1; b = $3 } next }
      { if (!n++ || $1 < low) low = $1; if ($1 > high) high = $1; sum += ($2 - a * $1^b)^2 }
      END { printf "scatter = %g; low = %g; high = %g", sqrt(sum / n), low, high }' \
    "fit$1" "points$1"; } >"law$1"
}

own=$#
if [ "$own" = 0 ]; then
  for run in CR SR CF SF; do set -- "$@" "$run.csv"; done
  K=0.5,0.83,0.5,0.83 R=0.04
  printf '%s\n' 'C on rubber' 'S on rubber' 'C on felt' 'S on felt' >names
fi
own_body
IFS=, read -r -a shapes <<<"$K"
[ ${#shapes[@]} = 1 ] || [ ${#shapes[@]} = $# ] ||
  { echo "$0: -K has ${#shapes[@]} values for $# files" >&2; exit 2; }
IFS=, read -r -a radii <<<"$R"
[ ${#radii[@]} = 1 ] || [ ${#radii[@]} = $# ] ||
  { echo "$0: -R has ${#radii[@]} values for $# files" >&2; exit 2; }
runs=0
for file; do
  runs=$((runs + 1))
  if [ "$own" -gt 0 ]; then
    name=${file##*/} && name=${name%.*} && printf '%s\n' "${name//[[:cntrl:]]/?}" >>names
    case $file in /* | -) ;; *) file=$called_from/$file ;; esac
  fi
  # What is read but once is copied: it is read twice here.
  [ -f "$file" ] || { cat -- "$file" >"run$runs" && file=run$runs; }
  shifts $runs "${shapes[runs - 1]:-${shapes[0]}}" "$file" "${radii[runs - 1]:-${radii[0]}}"
done

frame='vmax = 0.5; Dmax = 2.2'
[ "$own" = 0 ] || frame=$(sort -g points* | awk '
  { if ($1 > v) v = $1; if ($2 > D) D = $2 }
  END { printf "vmax = %g; Dmax = %g", 1.05 * v, 1.35 * D }')
for i in $(seq $runs); do
  "$samples/law.sh" -f "$(awk "BEGIN { $frame; print 0.04 * vmax }")" \
    -t "$(awk "BEGIN { $frame; print vmax }")" -n 200 "fit$i" >"band$i"
done
title='Fig. 4: the shift D against the velocity, with power laws and their 95 % bands'
given="K = $K, R = $R m" && [ "$slope" = 0 ] || given+=", slope $slope"
given=${given//+-/ ± }
draw 520 480 "count = $runs; own = $own; $frame; given = '$given'" <<'PLOT'
set xlabel 'velocity v / (m/s)'; set ylabel 'shift D / mm'
set xrange [0:vmax]; set yrange [0:Dmax]
set style fill transparent solid 0.2 noborder
set key top left width 2
if (own) { set key maxrows 4 } else { set key maxrows 2 }
told = own && count <= 4   # the key has the laws
# The key has four columns of four names. What does not fit gnuplot leaves out without a word, so
# long names lose their middle: of a line of small letters each column takes 8 for its symbol.
named = count > 16 ? 16 : count
room = 34
if (told) { room = 14; set key Left reverse width 0 font ',11' samplen 1.5 }
if (named > 4) { set key font ',11' samplen 2.6; room = 50/((named + 3)/4) - 8 }
cut(name) = strlen(name) <= room ? name : \
  substr(name, 1, (room - 1)/2).'…'.substr(name, strlen(name) - room/2 + 1, strlen(name))
array style[8] = [1, 3, 5, 7, 2, 4, 6, 8]  # every run of somebody's own in another colour
line(i) = !own ? i : style[(i-1)%8 + 1]
# "0.1004 ± 0.0006": three decimals, or as many as show the uncertainty
decimals(s) = s > 0 && s < 1e-3 ? ceil(-log10(s)) : 3
known(x, s) = sprintf(sprintf('%%.%df ± %%.%df', decimals(s), decimals(s)), x, s)
array title[count]; array least[count]; array most[count]
do for [i = count:1:-1] {
  eval system(sprintf('cat law%d', i))
  least[i] = low; most[i] = high
  title[i] = cut(system(sprintf('sed -n %dp names', i)))
  if (told) { title[i] = title[i].sprintf(':  a = %s mm,  b = %s', \
    known(1e3*a, 1e3*sigma_a), known(b, sigma_b)) }
}
note = "Points: the free roll, less five rows at each end."
if (own) { note = note."\n".given.(told ? ";  a is D at 1 m/s" : "") }
note = (own && count == 1 ? "Band: 95 % confidence of the law. Bars: scatter.\n" : \
  "Bands: 95 % confidence of the law, not of the points.\n").note
if (named < count) { note = sprintf("The key names the first %d of %d runs.\n", named, count).note }
set label note at graph 0.98, (named < count ? 0.145 : own ? 0.105 : 0.065) right font ',12' \
  noenhanced
if (!own) { set label 'rubber' at 0.495, 1.74 right; set label 'felt' at 0.495, 0.77 right }
file(name, i) = sprintf('%s%d', name, i)
inside(i, v) = v >= least[i] && v <= most[i] ? v : NaN
outside(i, v) = v >= least[i] && v <= most[i] ? NaN : v
# The law is a full line where there are points, a dotted one elsewhere.
plot for [i=1:count] file('band', i) using 1:(1e3*$5):(1e3*$6) with filledcurves ls line(i) notitle, \
     for [i=1:count] file('points', i) using 1:2 with points ls line(i) notitle, \
     for [i=1:count] file('band', i) using (outside(i, $1)):(1e3*$2) with lines ls line(i) dt 3 \
       notitle, \
     for [i=1:count] file('band', i) using (inside(i, $1)):(1e3*$2) with lines ls line(i) notitle, \
     for [i=1:(own && count == 1)] file('points', i) using 1:($2 - scatter):(0):(2*scatter) \
       with vectors nohead ls line(i) lw 0.5 notitle, \
     for [i=1:named] keyentry with linespoints ls line(i) ps 0.9 title title[i] noenhanced
PLOT
