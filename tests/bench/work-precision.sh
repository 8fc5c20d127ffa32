#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# work-precision.sh FOLDER - log-log figures of the tables FOLDER/*.txt, as SVG and PNG, and who failed how.
set -u
export LC_ALL=C
unset CDPATH
style=$PWD/samples/figures/style.gp
cd "$1" || exit 2
echo "# failures: problem, by, method: how often of the tolerances, and how"
for table in *.txt; do  # b=0.txt among them, which awk must not take for b = "0.txt"
  awk -F '\t' -v problem="${table%.txt}" '/failed: / {
    how = $8; sub(/ at t = .*/, "", how); key = problem "\t" $1 "\t" $2 "\t" how; n[key]++ }
    END { for (key in n) print key "\t" n[key] }' "./$table"
done | sort
command -v gnuplot >/dev/null || { echo "no figures: gnuplot is not installed" && exit 0; }
# A curve for each method that came through at least once: this project's filled and full, GSL's own steppers and CVODE open and dashed.
for table in *.txt; do
  series=$(awk -F '\t' '!/^#/ && $4 != "nan" && NF > 7 { key = $1 " " $2; if (!seen[key]++) printf "\"%s\" ", key }' "./$table")
  for terminal in svg pngcairo; do
    LC_ALL=C.UTF-8 gnuplot "$style" /dev/stdin <<GP || exit 2
      set terminal $terminal size 720,520 font 'sans-serif,14' background 'white'
      set output '${table%.txt}.${terminal%cairo}'
      set title '${table%.txt}' noenhanced
      set logscale xy; set format xy '10^{%L}'; set yrange [1e-18:1]; set xrange [10:1e7]
      set key below font ',12' samplen 1.5 height 0.6
      set xlabel 'time a sample / ns'; set ylabel 'largest error of v, over v_0' offset 0, 0
      methods = 'closed exact rkf45 rk8pd rk4imp bsimp msbdf adams bdf'; series = '$series'
      array hue[9] = [0x000000, 0x000000, 0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0x56B4E9, 0x8C6D1F, 0x7F7F7F]
      array mark[9] = [4, 2, 6, 8, 10, 12, 14, 2, 1]
      number_of(method) = sum [i = 1:9] (word(methods, i) eq method ? i : 0)
      m(s) = number_of(word(word(series, s), 2)); own(s) = word(word(series, s), 1) eq 'rolling'
      do for [s = 1:words(series)] { set style line s lc rgb hue[m(s)] lw 1.5 dt 2 - own(s) pt mark[m(s)] + own(s) ps 0.7 }
      is(s) = strcol(1).' '.strcol(2) eq word(series, s)
      plot for [s = 1:words(series)] '$table' using (is(s) ? \$7 : NaN):(\$4 < 1e-17 ? 1e-17 : \$4) \
        with linespoints ls s title word(series, s)
GP
  done
done

# Nine that differ most in one picture, where all of them were measured.
panels='CR exact-CR table-50 slope turn bowl b=0.9 memory-1e-3 memory-1e-6'
for panel in $panels; do [ -s "$panel.txt" ] || exit 0; done
LC_ALL=C.UTF-8 gnuplot "$style" /dev/stdin <<GP || exit 2
  set terminal svg size 960,900 font 'sans-serif,12' background 'white'
  set output 'overview.svg'
  panels = '$panels'
  methods = 'closed exact rkf45 rk8pd rk4imp bsimp msbdf'
  array titles[9] = ['cylinder on rubber, A = 1', 'exact geometry', 'a law of 50 points', 'up a slope, to the stop', 'up a slope and back', 'a ball in a bowl', 'b = 0.9', 'memory of 1 mm, stiff', 'memory of 1 µm, very stiff']
  array hue[7] = [0x000000, 0x000000, 0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0x56B4E9]
  array mark[7] = [5, 4, 7, 9, 11, 13, 15]
  set logscale xy; set format xy '10^{%L}'; set yrange [1e-18:1]; set xrange [10:1e7]; set xtics 100; set ytics 1e4
  set multiplot layout 3, 3 margins 0.09, 0.985, 0.115, 0.965 spacing 0.06, 0.075
  do for [p = 1:9] {
    set title titles[p] noenhanced offset 0, -0.5
    set ylabel (p % 3 == 1 ? 'largest error of v / v_0' : '')
    set xlabel (p > 6 ? 'time a sample / ns' : '')
    if (p == 8) { set key at screen 0.53, 0.03 center maxrows 1 samplen 1 font ',12' } else { unset key }
    plot for [m = 1:7] word(panels, p).'.txt' \
      using (strcol(1) eq 'rolling' && strcol(2) eq word(methods, m) && strcol(4) ne 'nan' ? \$7 : NaN):(\$4 < 1e-17 ? 1e-17 : \$4) \
      with linespoints lc rgb hue[m] lw 1.5 pt mark[m] ps 0.6 title word(methods, m)
  }
  unset multiplot
GP
