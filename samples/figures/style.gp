# SPDX-License-Identifier: GPL-3.0-or-later
# What the figures share. Colours of Okabe and Ito, safe for the colour-blind: rubber vermilion,
# felt blue. The body by symbol and dash, legible in grey: C filled circles and full lines, S
# crosses and dashed lines.
set encoding utf8
set minussign
set border 3 lw 1
set tics nomirror out scale 0.6
set xlabel offset 0, 0.4
set ylabel offset 1, 0
set datafile separator tab
set key top right samplen 2 spacing 1.15
set style line 1 lc rgb '#D55E00' lw 2 dt 1 pt 7 ps 0.55
set style line 2 lc rgb '#D55E00' lw 2 dt 2 pt 2 ps 0.65
set style line 3 lc rgb '#0072B2' lw 2 dt 1 pt 7 ps 0.55
set style line 4 lc rgb '#0072B2' lw 2 dt 2 pt 2 ps 0.65
do for [i = 1:4] { set style line 10 + i lc rgb 'black' lw 1.5 dt 2 - i % 2 }
black = 0x000000; grey = 0xA0A0A0; pale = 0xE8E4DC; green = 0x009E73
purple = 0xCC79A7; blue = 0x0072B2; vermilion = 0xD55E00
number(x) = (x < 0 ? '−' : '').sprintf('%.3g', abs(x))
# 13.5 N, 13.8 mN m, 14.7 kN
quantity(x, unit) = abs(x) >= 1e6 ? number(x/1e6).' M'.unit : abs(x) >= 1e3 ? number(x/1e3).' k'.unit : \
  x == 0 || abs(x) >= 0.1 ? number(x).' '.unit : abs(x) >= 1e-4 ? number(1e3*x).' m'.unit : \
  number(1e6*x).' µ'.unit
# For runs of somebody's own, after the four experiments.
set style line 5 lc rgb '#009E73' lw 2 dt 1 pt 9 ps 0.6
set style line 6 lc rgb '#009E73' lw 2 dt 2 pt 4 ps 0.55
set style line 7 lc rgb '#CC79A7' lw 2 dt 1 pt 13 ps 0.7
set style line 8 lc rgb '#000000' lw 2 dt 2 pt 6 ps 0.55
