#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tests/bench/signal.sh FOLDER [SEEDS]: the errors of smooth and differentiate on noisy runs, as
# FOLDER/signal.tsv, with SciPy's beside them where it is installed; against the window as
# FOLDER/signal.svg and against the run time as FOLDER/filters.svg, if gnuplot is. Prints the best and
# the usual for each scene.
set -euo pipefail
export LC_ALL=C
unset CDPATH
folder=$1 seeds=${2:-200}
table=$folder/signal.tsv style=$PWD/samples/figures/style.gp
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
  (cd "$folder" && LC_ALL=C.UTF-8 gnuplot "$style" /dev/stdin) <<'END'
set terminal svg size 1200,750 font 'sans,11' background 'white'
set output 'signal.svg'
set logscale y; set xrange [0:63]; set yrange [0.008:5]
set xlabel 'width [rows]'; set ylabel 'relative error of D'
set key outside right
methods = 'mean+central median+central savgol+central savgol1 savgol2 spline'
array names[6] = ['mean, central', 'median, central', 'savgol 2, central', 'savgol 1', 'savgol 2', 'spline']
array hue[6] = [1, 4, 2, 7, 2, 3]
is(scene, name) = strcol(1) eq scene && strcol(2) eq name
set multiplot layout 2,2 title "Error of D against the window, 25 Hz sonar \
(thick: v' of the same fit; dashed: smoothed, then central)"
do for [scene in 'CF CR SF SR'] {
  set title scene
  plot for [m = 1:3] 'signal.tsv' using (is(scene, word(methods, m)) ? $3 : NaN):9 \
         with linespoints lt hue[m] dt 2 title names[m], \
       for [m = 4:5] 'signal.tsv' using (is(scene, word(methods, m)) ? $3 : NaN):9 \
         with linespoints lt hue[m] lw 2 title names[m], \
       'signal.tsv' using (is(scene, 'spline') ? 0 : NaN):9:(63):(0) with vectors nohead lt hue[6] title names[6]
}
unset multiplot
END
  # Error against run time, on rubber and on felt: the kept figure samples/filters.svg.
  (cd "$folder" && LC_ALL=C.UTF-8 gnuplot "$style" /dev/stdin) <<'END'
set terminal svg size 960,420 font 'sans-serif,12' background 'white'
set output 'filters.svg'
scenes = 'CR CF'; array titles[2] = ['cylinder on rubber', 'cylinder on felt']
windows = 'mean+central median+central savgol+central savgol1 savgol2'
array names[5] = ['smooth (mean), central', 'smooth -M median, central', 'smooth -M savgol, central', \
  'savgol --order 1', 'savgol']
array hue[5] = [0x000000, 0xA0A0A0, 0x56B4E9, 0x009E73, 0xD55E00]
points = 'pasco vernier spline scipy_savgol2 scipy_spline_of_x'
array marks[5] = ['pasco', 'vernier', 'spline', 'SciPy, savgol', 'SciPy, spline of x']
array mark[5] = [8, 10, 9, 2, 1]
alone = system('grep -c scipy signal.tsv') > 0 ? 5 : 3
is(scene, name) = strcol(1) eq word(scenes, scene) && strcol(2) eq name
set logscale xy; set xrange [0.005:20]; set yrange [0.005:2]; set grid ytics lw 0.5 lc rgb pale
set xtics ('10 ns' 0.01, '0.1 µs' 0.1, '1 µs' 1, '10 µs' 10)
set ytics ('1 %%' 0.01, '3 %%' 0.03, '10 %%' 0.1, '30 %%' 0.3, '100 %%' 1)
set xlabel 'time a row'
set multiplot layout 1, 2 margins 0.09, 0.98, 0.32, 0.93 spacing 0.08
do for [p = 1:2] {
  set title titles[p] offset 0, -0.5
  set ylabel (p == 1 ? 'error of D' : '') offset 0, 0
  if (p == 1) { set key at screen 0.53, 0.02 center bottom maxrows 3 width -3 samplen 1.5 font ',11' } else { unset key }
  plot for [m = 1:5] 'signal.tsv' using (is(p, word(windows, m)) ? 1e6*$10 : NaN):9 \
         with linespoints lc rgb hue[m] lw 1.5 pt 7 ps 0.4 title names[m], \
       for [m = 1:alone] 'signal.tsv' using (is(p, word(points, m)) ? 1e6*$10 : NaN):9 \
         with points lc rgb 0x0072B2 pt mark[m] ps 0.9 title marks[m]
}
unset multiplot
END
fi
