#!/bin/bash
# Fig. 4, D(v) of the four experiments, the power laws fitted to them, and the 95 % band of each law. `make figures/fig4.svg`
. "$(dirname "$0")/draw.sh"
laws=''
shifts() {  # NAME K
  smooth -q --coast -c x -w 1 "$1.csv" | differentiate -c x | smooth -w 11 |
    differentiate | shift-from-accel -K "$2" -R 0.04 >"$1"
  whole_windows <"$1" >"$1.D"  # for the picture: fitpower knows by the ## lines how noisy the ends are
  laws+=$(fitpower -q "$1" | assignments | sed "s/\([a-z_]*\) =/$1_\1 =/g")
}
shifts CR 0.5; shifts SR 0.83; shifts CF 0.5; shifts SF 0.83
draw 720 560 "$laws" <<'PLOT'
set xlabel 'velocity v / (m/s)'; set ylabel 'shift D / mm'
set xrange [0:0.5]; set yrange [0:2.2]; set samples 201; set style fill transparent solid 0.2 noborder
set key top left maxrows 2 width 2
set label 'rubber' at 0.495, 1.74 right; set label 'felt' at 0.495, 0.68 right
of(run, name) = value(run.'_'.name)
D(run, v) = 1e3*of(run, 'a')*v**of(run, 'b')
# The law by name of its run, and sigma of ln D = ln a + b ln v.
sigma(run, v) = (s = of(run, 'sigma_a')/of(run, 'a'), l = of(run, 'sigma_b')*log(v), sqrt(s**2 + l**2 + 2*of(run, 'corr')*s*l))
edge(run, v, sign) = v > 0.02 ? D(run, v)*exp(sign*1.96*sigma(run, v)) : NaN
plot for [i=1:4] '+' using 1:(edge(word(runs,i),$1,-1)):(edge(word(runs,i),$1,1)) with filledcurves ls i notitle, \
     for [i=1:4] word(runs,i).'.D' using 4:(1e3*column(6)) with points ls i notitle, \
     for [i=1:4] [v=0.02:0.5] '+' using 1:(D(word(runs,i),$1)) with lines ls i notitle, \
     for [i=1:4] keyentry with linespoints ls i ps 0.9 title label[i]
PLOT
