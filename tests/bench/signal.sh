#!/bin/bash
# tests/bench/signal.sh FOLDER: the errors of smooth and differentiate on noisy records, as FOLDER/signal.tsv, with SciPy's
# beside them where it is installed, and against window and run time as FOLDER/signal{,-time}.{svg,png} where gnuplot is.
# Prints the best and the usual for each scene.
set -euo pipefail
export LC_ALL=C
unset CDPATH
folder=$1
build/bench/signal >"$folder/signal.tsv"
if /usr/bin/python3 -c 'import scipy' 2>/dev/null; then
  build/bench/signal records 200 | /usr/bin/python3 tests/bench/signal_scipy.py >>"$folder/signal.tsv"
else
  echo "SciPy is not installed: its rows are left out" >&2
fi
echo "# error of D inside, relative, by method, at the width that is best for the scene and at the usual one"
awk -F'\t' -v OFS='\t' '
  /^#/ { next }
  { key = $1 OFS $2; if (!(key in least) || $9 + 0 < least[key]) { least[key] = $9; best[key] = $3; ends[key] = $8 } if (!(key in order)) { order[key] = ++n; name[n] = key } }
  $3 == ($2 == "mean+central" || $2 == "median+central" ? 11 : 23) { usual[key] = $9 }
  END {
    print "# scene", "method", "best_width", "error_D", "ends_a[m/s^2]", "error_D_at_default"
    for (i = 1; i <= n; i++) print name[i], best[name[i]], least[name[i]], ends[name[i]], name[i] in usual ? usual[name[i]] : "NaN"
  }' "$folder/signal.tsv"
if command -v gnuplot >/dev/null; then
  for terminal in svg pngcairo; do
    gnuplot <<END
folder = "$folder"
suffix = "$terminal" eq "svg" ? ".svg" : ".png"
set terminal $terminal size 1200,750 font "sans,11" background "white"
set datafile separator "\t"
set logscale y
set yrange [0.008:5]
set ylabel "relative error of D"
pick(scene, method) = sprintf("< awk -F'\\\\t' '\$1 == \"%s\" && \$2 == \"%s\"' %s/signal.tsv", scene, method, folder)
level(scene, method) = real(system(sprintf("awk -F'\\\\t' '\$1 == \"%s\" && \$2 == \"%s\" { print \$9 }' %s/signal.tsv", scene, method, folder)))

set output folder . "/signal" . suffix
set multiplot layout 2,2 title "Error of D against the window, 25 Hz sonar (thick: v' of the same fit; dashed: smoothed, then central)"
set xrange [0:63]
set xlabel "width [records]"
set key outside right
do for [scene in "CF CR SF SR"] {
  set title scene
  plot pick(scene, "mean+central") using 3:9 with linespoints dt 2 lc 1 title "mean, central", \
       pick(scene, "median+central") using 3:9 with linespoints dt 2 lc 4 title "median, central", \
       pick(scene, "savgol+central") using 3:9 with linespoints dt 2 lc 2 title "savgol 2, central", \
       pick(scene, "savgol1") using 3:9 with linespoints lw 2 lc 7 title "savgol 1", \
       pick(scene, "savgol2") using 3:9 with linespoints lw 2 lc 2 title "savgol 2", \
       level(scene, "spline") lc 3 title "spline"
}
unset multiplot

set output folder . "/signal-time" . suffix
set multiplot layout 2,2 title "Error of D against run time, windows of 5 to 61 records along the lines"
set logscale x
set xrange [0.02:20]
set xlabel "us a record"
do for [scene in "CF CR SF SR"] {
  set title scene
  plot pick(scene, "mean+central") using (1e6*\$10):9 with linespoints dt 2 lc 1 title "mean, central", \
       pick(scene, "savgol+central") using (1e6*\$10):9 with linespoints dt 2 lc 2 title "savgol 2, central", \
       pick(scene, "savgol1") using (1e6*\$10):9 with linespoints lw 2 lc 7 title "savgol 1", \
       pick(scene, "savgol2") using (1e6*\$10):9 with linespoints lw 2 lc 2 title "savgol 2", \
       pick(scene, "pasco") using (1e6*\$10):9 with points lc 4 title "pasco", \
       pick(scene, "vernier") using (1e6*\$10):9 with points lc 5 title "vernier", \
       pick(scene, "spline") using (1e6*\$10):9 with points lc 3 title "spline", \
       pick(scene, "spline_of_x+central") using (1e6*\$10):9 with points lc 6 title "spline of x, central", \
       pick(scene, "scipy_savgol2") using (1e6*\$10):9 with points lc 8 title "SciPy savgol 2", \
       pick(scene, "scipy_spline_of_x") using (1e6*\$10):9 with points lc 9 title "SciPy spline of x"
}
unset multiplot
END
  done
fi
