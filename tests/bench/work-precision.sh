#!/bin/bash
# work-precision.sh FOLDER - log-log figures of the tables FOLDER/*.txt, as SVG and PNG, and who failed how.
set -u
cd "$1" || exit 2
echo "# failures: problem, by, method: how often of the tolerances, and how"
for table in *.txt; do
  awk -F '\t' -v problem="${table%.txt}" '/failed: / {
    how = $9; sub(/ at t = .*/, "", how); key = problem "\t" $1 "\t" $2 "\t" how; n[key]++ }
    END { for (key in n) print key "\t" n[key] }' "$table"
done | sort
command -v gnuplot >/dev/null || { echo "no figures: gnuplot is not installed" && exit 0; }
for table in *.txt; do
  for terminal in svg png; do
    gnuplot <<GP || exit 2
      set terminal $([ $terminal = svg ] && echo "svg size 800,600 background 'white'" || echo "png size 800,600")
      set output '${table%.txt}.$terminal'
      set title '${table%.txt}: error of v against time'
      set logscale xy
      set format y '10^{%L}'
      set xlabel 'time a sample [ns]'
      set ylabel 'largest |error of v| / v0 (below 1e-17: 1e-17)'
      set yrange [1e-18:10]
      set xrange [10:1e7]
      set key outside right
      methods = 'closed exact rkf45 rk8pd rk4imp bsimp msbdf'
      set datafile separator "\t"
      plot for [who in "rolling GSL GSL-odd"] for [m = 1:7] '$table' \
        using (strcol(1) eq who && strcol(2) eq word(methods, m) ? \$7 : NaN):(\$4 < 1e-17 ? 1e-17 : \$4) with linespoints \
        pointtype (who eq 'rolling' ? 7 : who eq 'GSL' ? 1 : 6) linecolor m title who.' '.word(methods, m)
GP
  done
done
