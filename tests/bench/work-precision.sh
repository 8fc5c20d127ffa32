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
      array mark[9] = [4, 4, 6, 8, 10, 12, 14, 2, 1]
      number_of(method) = sum [i = 1:9] (word(methods, i) eq method ? i : 0)
      m(s) = number_of(word(word(series, s), 2)); own(s) = word(word(series, s), 1) eq 'rolling'
      do for [s = 1:words(series)] { set style line s lc rgb hue[m(s)] lw 1.5 dt 2 - own(s) pt mark[m(s)] + own(s) ps 0.7 }
      is(s) = strcol(1).' '.strcol(2) eq word(series, s)
      plot for [s = 1:words(series)] '$table' using (is(s) ? \$7 : NaN):(\$4 < 1e-17 ? 1e-17 : \$4) \
        with linespoints ls s title word(series, s)
GP
  done
done
