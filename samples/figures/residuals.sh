#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The residuals of a fit against time and against velocity: the first look at whether a law describes
# a run.
#
#   residuals.sh [-t svg | pngcairo] [-K K -R R [--slope S] [-c x|v] [--use NAME=COLUMN]... FILE] \
#     >residuals.svg
#
# FILE is a run with the columns t and x, or t and v (samples/CR.csv without one); the options are those
# of fig4.sh. What is fitted are the positions of the free roll, or the velocities with -c v or where
# there are no positions. The picture says the law, the rms of the fit beside the scatter that half of the rows
# show, how many rows were left out, and where; and it names the times of rows that are more than five
# times the scatter off. `make figures/residuals.svg`
. "$(dirname "$0")/draw.sh"
[ $# -le 1 ] || { help >&2; exit 2; }
[ $# = 1 ] || K=0.5 R=0.04
own_body
file=${1:-CR.csv}
name=${file##*/} && name=${name%.*}
[ $# = 0 ] || case $file in /* | -) ;; *) file=$called_from/$file ;; esac
# What is read but once is copied: it is read more than once here.
[ -f "$file" ] || { cat -- "$file" >run && file=run; }

rms='' t0=''
route=position unit=mm
if [ "$column" != v ] && read_run x -w 1 "$file" >readings 2>said; then column=x
else
  [ "$column" != x ] || { cat said >&2; exit 2; }
  route=velocity column=v unit=mm/s
  read_run v -w 1 "$file" >readings
fi
read_run $column --coast -w 1 "$file" >roll
fitpower -q --route $route -K "$K" -R "$R" --slope "$slope" roll >fit
eval "$(assignments <fit | sed "s/ = /=/g")"

# of_name FILE NAME: that column, a number a line.
of_name() {
  awk -F'\t' -v want="$2" '
    /^##/ { next }
    /^# / { sub(/^# /, ""); for (i = 1; i <= NF; i++) if (index($i, want "[") == 1) at = i; next }
    NF { print $at }' "$1"
}
# The roll of the row, from its t0, v0 and x0 on, at the times of the run; of one towards falling x
# the signs are turned.
simulate -q --law fit -K "$K" -R "$R" --slope="$slope" --at roll >law
paste <(of_name roll t) <(of_name roll $column) <(of_name law $column) <(of_name law v) |
  awk 'NR == 1 { way = $4 < 0 ? -1 : 1 }
    { printf "%s\t%.9g\t%.9g\n", $1, ($4 < 0 ? -$4 : $4), 1e3 * way * ($2 - $3) }' >residuals

# What the picture says. The scatter is the median of |residual|, over 0.6745 that of a normal one.
missing=$(($(read_run t -w 1 "$file" | grep -c '^[^#]') - $(grep -c '^[^#]' readings)))
scatter=$(awk '{ print ($3 < 0 ? -$3 : $3) }' residuals | sort -g |
  awk '{ r[NR] = $1 } END { print (r[int((NR + 1) / 2)] + r[int(NR / 2) + 1]) / 2 / 0.6745 }')
awk -v scatter="$scatter" '{ r = $3 < 0 ? -$3 : $3 } r > 5 * scatter' residuals >outliers
label=${name//[[:cntrl:]]/?} && [ ${#label} -le 24 ] || label=${label:0:11}…${label: -12}
{
  printf '%s:  ' "$label"
  awk "BEGIN { $(assignments <fit)"'
    printf "a = %.3f ± %.3f mm,  b = %.3f ± %.3f", 1e3 * a, 1e3 * sigma_a, b, sigma_b }'
  printf '\nK = %s,  R = %s m;  ' "${K//+-/ ± }" "${R//+-/ ± }"
  [ "$slope" = 0 ] || printf 'slope %s;  ' "${slope//+-/ ± }"
} >heading
awk -v unit=$unit -v rms="$rms" -v scatter="$scatter" -v rows="$(wc -l <residuals)" \
  -v readings="$(grep -c '^[^#]' readings)" -v missing="$missing" -v outliers="$(wc -l <outliers)" '
  BEGIN { printf "rms %.3g %s, scatter %.3g %s\n%d of %d rows, %d without a reading; %s\n", 1e3 * rms, unit,
    scatter, unit, rows, readings + missing, missing,
    (outliers == 0 ? "no outlier" : outliers == 1 ? "1 outlier" : outliers " outliers") }' >>heading

last=$(tail -n 1 residuals | cut -f 1)
left_out() { of_name readings t | awk -v first="$t0" -v last="$last" "\$1 $1 { ++n } END { print n + 0 }"; }
title="Residuals of $(head -n 1 heading | sed 's/[&<>\\|]/./g')"
draw 520 640 "unit = '$unit'; first = $t0; last = $last; rms = 1e3*$rms; \
  before = $(left_out '< first'); after = $(left_out '> last'); outliers = $(wc -l <outliers)" <<'PLOT'
set multiplot layout 2,1 margins 0.16,0.97,0.09,0.88 spacing 0.12
stats 'residuals' using 3 nooutput
most = 1.25*(STATS_max > -STATS_min ? STATS_max : -STATS_min); if (most < 2.5*rms) { most = 2.5*rms }
set label 1 system('cat heading') at screen 0.02, 0.97 left font ',12' noenhanced
set ylabel 'residual / '.(unit eq 'mm' ? unit : '('.unit.')'); set yrange [-most:most]; set xzeroaxis lt -1 lw 0.5
set arrow 1 from graph 0, first rms to graph 1, first rms nohead dt 2 lc rgb grey
set arrow 2 from graph 0, first -rms to graph 1, first -rms nohead dt 2 lc rgb grey
set label 2 'rms' at graph 1, first rms right offset 0, 0.5 textcolor rgb 0x606060 font ',12'
margin = 0.12*(last - first)
set xlabel 'time t / s'; set xrange [first - margin:last + margin]
if (before) {
  set object 1 rectangle from graph 0, 0 to first first - 0.1*margin, graph 1 fc rgb pale fs solid noborder
  set label 3 "left\nout" at graph 0.01, 0.12 left font ',12'
}
if (after) {
  set object 2 rectangle from first last + 0.1*margin, graph 0 to graph 1, 1 fc rgb pale fs solid noborder
  set label 4 "left\nout" at graph 0.99, 0.12 right font ',12'
}
named(t) = sprintf('t = %s s', t)
marks(x) = outliers == 0 ? '' : sprintf("'outliers' using %d:3 with points pt 6 ps 1.2 lw 1.5 lc rgb black notitle, ", x). \
  sprintf("'outliers' using %d:3:(named(strcol(1))) with labels offset 0, 0.9 font ',11' notitle", x)
eval "plot 'residuals' using 1:3 with points ls 1 notitle, ".marks(1)
unset object; unset label 3; unset label 4; unset label 1
set xlabel 'velocity v / (m/s)'; set xrange [0:*]
eval "plot 'residuals' using 2:3 with points ls 3 notitle, ".marks(2)
PLOT
