#!/bin/bash
# Fig. 4: D against v, the power law fitted to it, and the 95 % band of the law.
#
#   fig4.sh [-t svg | pngcairo] >fig4.svg                          the four experiments
#   fig4.sh [-t ...] [-K K[,K...]] [-R R] FILE... >mine.svg        records of your own
#
# K (0.5) is the shape factor, one for all files or one for each; R (0.04) the radius in metres. A
# file has the columns t and x (Time, Position), or t and v (Time, Velocity). Of each record the
# free roll is taken; of one towards falling x the signs are turned. `make figures/fig4.svg` draws
# the experiments.
. "$(dirname "$0")/draw.sh"

# D against v of record $1, the file $3, with the shape factor $2, and the row of the law.
shifts() {
  if smooth -q -c x -w 1 "$3" >/dev/null 2>&1; then
    smooth -q --coast -c x -w 1 "$3" | differentiate -c x | smooth -q -w 11
  else
    smooth -q --coast -c v -w 11 "$3"
  fi | differentiate -c v | shift-from-accel -q -K "$2" -R "$R" >"shift$1"
  fitpower -q "shift$1" | grep -v '^#' >>laws
  # The picture has the rows of whole windows alone; fitpower knows the noise of all of them.
  whole_windows <"shift$1" | awk -F'\t' '
    /^# / { for (i = 1; i <= NF; i++) { if ($i ~ /^v\[/) v = i; if ($i ~ /^D\[/) D = i } next }
    /^[^#]/ {
      if (!way) way = $v < 0 ? -1 : 1
      print (way < 0 ? sprintf("%.17g", -$v) : $v) "\t" way * 1e3 * $D
    }' >"points$1"
}

own=$#
if [ "$own" = 0 ]; then
  for run in CR SR CF SF; do set -- "$@" "$run.csv"; done
  K=0.5,0.83,0.5,0.83
  printf '%s\n' 'C on rubber' 'S on rubber' 'C on felt' 'S on felt' >names
fi
IFS=, read -r -a shapes <<<"$K"
[ ${#shapes[@]} = 1 ] || [ ${#shapes[@]} = $# ] ||
  { echo "$0: -K has ${#shapes[@]} values for $# files" >&2; exit 2; }
runs=0
for file; do
  runs=$((runs + 1))
  if [ "$own" -gt 0 ]; then
    name=${file##*/} && name=${name%.*} && printf '%s\n' "${name//[[:cntrl:]]/?}" >>names
    case $file in /* | -) ;; *) file=$called_from/$file ;; esac
  fi
  # What is read but once is copied: it is read twice here.
  [ -f "$file" ] || { cat -- "$file" >"record$runs" && file=record$runs; }
  shifts $runs "${shapes[runs - 1]:-${shapes[0]}}" "$file"
done

frame='vmax = 0.5; Dmax = 2.2'
[ "$own" = 0 ] || frame=$(sort -g points* | awk '
  { if ($1 > v) v = $1; if ($2 > D) D = $2 }
  END { printf "vmax = %g; Dmax = %g", 1.05 * v, 1.35 * D }')
draw 720 560 "n = $runs; own = $own; $frame" <<'PLOT'
set xlabel 'velocity v / (m/s)'; set ylabel 'shift D / mm'
set xrange [0:vmax]; set yrange [0:Dmax]; set samples 201
set style fill transparent solid 0.2 noborder
set key top left width 2
if (own) { set key maxrows 4 } else { set key maxrows 2 }
# The key has four columns of four names. What does not fit gnuplot leaves out without a word, so
# long names lose their middle: of a line of small letters each column takes 8 for its symbol.
named = n > 16 ? 16 : n
room = 40; if (named > 4) { set key font ',11' samplen 2.6; room = 58/((named + 3)/4) - 8 }
cut(name) = strlen(name) <= room ? name : \
  substr(name, 1, (room - 1)/2).'…'.substr(name, strlen(name) - room/2 + 1, strlen(name))
note = "Bands: 95 % confidence of the law, not of the points.\nPoints: \
the free roll, less five records at each end."
if (named < n) { note = sprintf("The key names the first %d of %d records.\n", named, n).note }
set label note at graph 0.98, (named < n ? 0.115 : 0.075) right font ',12'
if (!own) { set label 'rubber' at 0.495, 1.74 right; set label 'felt' at 0.495, 0.68 right }
array a[n]; array sigma_a[n]; array b[n]; array sigma_b[n]; array corr[n]
array title[n]
do for [i=1:n] {
  law = system(sprintf('sed -n %dp laws', i))
  a[i] = real(word(law, 1)); sigma_a[i] = real(word(law, 2))
  b[i] = real(word(law, 3)); sigma_b[i] = real(word(law, 4)); corr[i] = real(word(law, 5))
  title[i] = system(sprintf('sed -n %dp names', i))
}
D(i, v) = 1e3*a[i]*v**b[i]
# The standard error of ln D = ln a + b ln v.
sigma(i, v) = (s = sigma_a[i]/a[i], l = sigma_b[i]*log(v), sqrt(s**2 + l**2 + 2*corr[i]*s*l))
edge(i, v, sign) = v > 0.04*vmax ? D(i, v)*exp(sign*1.96*sigma(i, v)) : NaN
array style[8] = [1, 3, 5, 7, 2, 4, 6, 8]  # every record of somebody's own in another colour
line(i) = !own ? i : style[(i-1)%8 + 1]
plot for [i=1:n] '+' using 1:(edge(i,$1,-1)):(edge(i,$1,1)) with filledcurves ls line(i) notitle, \
     for [i=1:n] sprintf('points%d', i) using 1:2 with points ls line(i) notitle, \
     for [i=1:n] [v=0.04*vmax:vmax] '+' using 1:(D(i,$1)) with lines ls line(i) notitle, \
     for [i=1:named] keyentry with linespoints ls line(i) ps 0.9 title cut(title[i]) noenhanced
PLOT
