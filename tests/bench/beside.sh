#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# beside.sh PYTHON FOLDER [RUNS]: the table of beside.py as FOLDER/beside.tsv, and FOLDER/fit-routes.svg,
# the scatter of b against the time of a fit, if gnuplot is installed.
set -euo pipefail
export LC_ALL=C
unset CDPATH
style=$PWD/samples/figures/style.gp
"$1" tests/bench/beside.py "${3:-200}" >"$2/beside.tsv"
command -v gnuplot >/dev/null || { echo "no figure: gnuplot is not installed" && exit 0; }
cd "$2"
LC_ALL=C.UTF-8 gnuplot "$style" /dev/stdin <<'END'
set terminal svg size 960,420 font 'sans-serif,12' background 'white'
set output 'fit-routes.svg'
scenes = 'CR CF'; array titles[2] = ['cylinder on rubber', 'cylinder on felt']
array by[8] = ['rolling', 'rolling of v', 'rolling, shift', 'rolling, loglog', 'lmfit', 'lmfit of v', \
  'scipy.odr', 'log-log by hand']
array hue[8] = [vermilion, vermilion, vermilion, vermilion, blue, blue, purple, 0x000000]
array mark[8] = [7, 5, 9, 11, 6, 4, 1, 2]
is(scene, name) = strcol(1) eq word(scenes, scene) && strcol(2) eq name
set logscale xy; set xrange [0.1:200]; set yrange [0.001:0.1]; set grid ytics lw 0.5 lc rgb pale
set xtics (0.1, 1, 10, 100)
set xlabel 'time of a fit / ms'
set multiplot layout 1, 2 margins 0.09, 0.98, 0.32, 0.93 spacing 0.08
do for [p = 1:2] {
  set title titles[p] offset 0, -0.5
  set ylabel (p == 1 ? 'standard deviation of b' : '')
  if (p == 1) { set key at screen 0.53, 0.02 center bottom maxrows 3 samplen 1 font ',11' } else { unset key }
  plot for [m = 1:8] 'beside.tsv' using (is(p, by[m]) ? $7 : NaN):3 with points lc rgb hue[m] lw 1.5 pt mark[m] \
    ps 0.9 title by[m]
}
unset multiplot
END
