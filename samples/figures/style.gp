# What the figures share: rubber vermilion, felt blue (safe for the colour-blind); C filled circles, S crosses; legible in grey.
set border 3
set tics nomirror out
set key top right samplen 1.5 spacing 1.1
set style line 1 lc rgb '#D55E00' lw 1.5 dt 1 pt 7 ps 0.5
set style line 2 lc rgb '#D55E00' lw 1.5 dt 2 pt 2 ps 0.6
set style line 3 lc rgb '#0072B2' lw 1.5 dt 1 pt 7 ps 0.5
set style line 4 lc rgb '#0072B2' lw 1.5 dt 2 pt 2 ps 0.6
