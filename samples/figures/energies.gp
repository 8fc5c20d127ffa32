# SPDX-License-Identifier: GPL-3.0-or-later
# The energies of a roll against time, below their axis the key: of the files fitted (t, E_trans, E_rot,
# E_diss and W_g in its columns 1 to 5) as lines, of measured as points. For energy and turn, which
# say how many of the four there are, parts.
set style line 1 lc rgb purple lw 2 dt 1 pt 7; set style line 2 lc rgb blue lw 2 dt 2 pt 2
set style line 3 lc rgb vermilion lw 2 dt 4 pt 9; set style line 4 lc rgb green lw 2 dt 5 pt 5
set style line 5 lc rgb black lw 2 dt 1 pt 4
array what[5] = ['translational', 'rotational', 'dissipated', 'lifted', 'sum']
shown(i) = i > parts ? 5 : i
stats 'fitted' using (column(2) + column(3) + column(4) + column(5)) nooutput
scale = STATS_max < 0.1 ? 1e3 : STATS_max < 1e3 ? 1 : 1e-3
energy(i) = scale*(shown(i) < 5 ? column(shown(i) + 1) : column(2) + column(3) + column(4) + column(5))
set xlabel 'time t / s'; set ylabel 'energy / '.(scale == 1 ? 'J' : scale > 1 ? 'mJ' : 'kJ')
set xrange [0:*]; set yrange [*<0:1.1*scale*STATS_max]; set rmargin at screen 0.97
set key outside center bottom horizontal maxcols 3 width -1 samplen 2 font ',12'
plot for [i=1:parts + 1] 'fitted' using ($1 - start):(energy(i)) with lines ls shown(i) notitle, \
     for [i=1:parts + 1] 'measured' using ($1 - start):(energy(i)) every thin('measured', 40) \
       with points ls shown(i) ps 0.7 notitle, \
     for [i=1:parts + 1] keyentry with linespoints ls shown(i) ps 0.7 title what[shown(i)], \
     keyentry with points ls 5 ps 0.7 title 'measured', keyentry with lines ls 5 title 'fitted'
