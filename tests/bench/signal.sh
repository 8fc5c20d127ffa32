#!/bin/bash
# tests/bench/signal.sh FOLDER: the errors of smooth and differentiate on noisy records, as FOLDER/signal.tsv, with SciPy's
# beside them where it is installed, and as FOLDER/signal.svg where gnuplot is. Prints the best and the usual for each scene.
set -euo pipefail
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
  gnuplot <<END
set terminal svg size 900,700 font "sans,12" background "white"
set output "$folder/signal.svg"
set datafile separator "\t"
set multiplot layout 2,2 title "Error of D against the window, 25 Hz sonar (thick: v' of the same fit; dashed: smoothed, then central)"
set logscale y
set xrange [0:63]
set yrange [0.008:30]
set xlabel "width [records]"
set ylabel "relative error of D"
set key top right
pick(scene, method) = sprintf("< awk -F'\\\\t' '\$1 == \"%s\" && \$2 == \"%s\"' $folder/signal.tsv", scene, method)
do for [scene in "CF CR SF SR"] {
  set title scene
  plot pick(scene, "mean+central") using 3:9 with linespoints dt 2 lc 1 title "mean, central", \
       pick(scene, "median+central") using 3:9 with linespoints dt 2 lc 4 title "median, central", \
       pick(scene, "savgol+central") using 3:9 with linespoints dt 2 lc 2 title "savgol 2, central", \
       pick(scene, "savgol1") using 3:9 with linespoints lw 2 lc 7 title "savgol 1", \
       pick(scene, "savgol2") using 3:9 with linespoints lw 2 lc 2 title "savgol 2"
}
END
fi
