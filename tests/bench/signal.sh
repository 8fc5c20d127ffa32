#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tests/bench/signal.sh FOLDER [SEEDS]: the errors of smooth and differentiate on noisy runs, as
# FOLDER/signal.tsv, with SciPy's beside them where it is installed, and against window and run time
# as FOLDER/signal{,-time}.{svg,png} where gnuplot is. Prints the best and the usual for each scene.
set -euo pipefail
export LC_ALL=C
unset CDPATH
folder=$1 seeds=${2:-200}
table=$folder/signal.tsv
build/bench/signal "$seeds" >"$table"
if /usr/bin/python3 -c 'import scipy' 2>/dev/null; then
  build/bench/signal runs "$seeds" | /usr/bin/python3 tests/bench/signal_scipy.py >>"$table"
else
  echo "SciPy is not installed: its rows are left out" >&2
fi
echo "# error of D inside, relative, by method, at the width best for the scene and at the usual one"
awk -F'\t' -v OFS='\t' '
  /^#/ { next }
  {
    key = $1 OFS $2
    if (!(key in least)) name[++n] = key
    if (!(key in least) || $9 + 0 < least[key]) { least[key] = $9; best[key] = $3; ends[key] = $8 }
  }
  $3 == ($2 == "mean+central" || $2 == "median+central" ? 11 : 23) { usual[key] = $9 }
  END {
    print "# scene", "method", "best_width", "error_D", "ends_a[m/s^2]", "error_D_at_default"
    for (i = 1; i <= n; i++) {
      key = name[i]
      print key, best[key], least[key], ends[key], key in usual ? usual[key] : "NaN"
    }
  }' "$table"
if command -v gnuplot >/dev/null; then
  for terminal in svg pngcairo; do
    # The name of the table reaches gnuplot's script through the environment: it is not code.
    TABLE=$table PICTURE=$folder TERMINAL=$terminal gnuplot <<'END'
suffix = system("echo $TERMINAL") eq "svg" ? ".svg" : ".png"
picture = system('printf %s "$PICTURE"')
if (suffix eq ".svg") { set terminal svg size 1200,750 font "sans,11" background "white" }
else { set terminal pngcairo size 1200,750 font "sans,11" background "white" }
set datafile separator "\t"
set logscale y
set yrange [0.008:5]
set ylabel "relative error of D"
rows(scene, method) = sprintf("awk -F'\\t' '$1 == \"%s\" && $2 == \"%s\"' \"$TABLE\"", \
                              scene, method)
pick(scene, method) = "< " . rows(scene, method)
level(scene, method) = real(system(rows(scene, method) . " | cut -f 9"))

set output picture . "/signal" . suffix
set multiplot layout 2,2 title "Error of D against the window, 25 Hz sonar \
(thick: v' of the same fit; dashed: smoothed, then central)"
set xrange [0:63]
set xlabel "width [rows]"
set key outside right
do for [scene in "CF CR SF SR"] {
  set title scene
  plot pick(scene, "mean+central") using 3:9 with linespoints dt 2 lc 1 title "mean, central", \
       pick(scene, "median+central") using 3:9 with linespoints dt 2 lc 4 \
         title "median, central", \
       pick(scene, "savgol+central") using 3:9 with linespoints dt 2 lc 2 \
         title "savgol 2, central", \
       pick(scene, "savgol1") using 3:9 with linespoints lw 2 lc 7 title "savgol 1", \
       pick(scene, "savgol2") using 3:9 with linespoints lw 2 lc 2 title "savgol 2", \
       level(scene, "spline") lc 3 title "spline"
}
unset multiplot

set output picture . "/signal-time" . suffix
set multiplot layout 2,2 title "Error of D against run time, windows of 5 to 61 rows along the \
lines"
set logscale x
set xrange [0.005:20]
set key samplen 2 font ",9"
set xlabel "us a row"
# What has no window is one point. SciPy's rows are there where it is installed.
single = "pasco vernier spline spline_of_x+central"
if (system('grep -c scipy "$TABLE"') > 0) { single = single . " scipy_savgol2 scipy_spline_of_x" }
do for [scene in "CF CR SF SR"] {
  set title scene
  plot pick(scene, "mean+central") using (1e6*$10):9 with linespoints dt 2 lc 1 \
         title "mean, central", \
       pick(scene, "savgol+central") using (1e6*$10):9 with linespoints dt 2 lc 2 \
         title "savgol 2, central", \
       pick(scene, "savgol1") using (1e6*$10):9 with linespoints lw 2 lc 7 title "savgol 1", \
       pick(scene, "savgol2") using (1e6*$10):9 with linespoints lw 2 lc 2 title "savgol 2", \
       for [i=1:words(single)] pick(scene, word(single, i)) using (1e6*$10):9 \
         with points lc 2 + i title word(single, i) noenhanced
}
unset multiplot
END
  done
fi
