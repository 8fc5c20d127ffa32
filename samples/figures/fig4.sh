#!/bin/bash
# Fig. 4, D(v) of the four experiments with the power laws fitted to them: `make figures/fig4.svg`
# Run in samples/ with the tools on PATH; writes gnuplot's output for the terminal in $1 (svg or pngcairo) to standard output.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
law=""
shifts() {  # NAME K: the points, and the law fitted to them with its band of one standard error
  smooth -q --coast -c x -w 1 "$1.csv" | differentiate -c x | smooth -w 11 | differentiate | shift-from-accel -K "$2" -R 0.04 >"$scratch/$1"
  # The first and last means have shrunken windows: fitpower weighs them, a picture leaves them away.
  awk '!/^#/ { row[++n] = $4 "\t" $6 } END { for (i = 6; i <= n - 5; i++) print row[i] }' "$scratch/$1" >"$scratch/$1.D"
  read -r a sa b sb corr _ < <(fitpower -q "$scratch/$1" | tail -n 1)
  law+="$1_a = $a; $1_sa = $sa; $1_b = $b; $1_sb = $sb; $1_corr = $corr; "
}
shifts CR 0.5; shifts SR 0.83; shifts CF 0.5; shifts SF 0.83
cd figures
gnuplot -e "scratch = '$scratch'; $law set terminal $1 size 800,500 font 'sans,12'" - <<'PLOT'
load 'style.gp'
set xlabel 'velocity v / (m/s)'; set ylabel 'shift D / mm'
set xrange [0.05:0.5]; set yrange [0:2.2]; set samples 200; set style fill transparent solid 0.15 noborder
# sigma of ln D at v: that of ln a + b ln v
sigma(sa, a, sb, corr, x) = sqrt((sa/a)**2 + (sb*log(x))**2 + 2*corr*(sa/a)*sb*log(x))
D(a, b, x) = 1e3*a*x**b
plot '+' using 1:(D(CR_a,CR_b,$1)*(1-sigma(CR_sa,CR_a,CR_sb,CR_corr,$1))):(D(CR_a,CR_b,$1)*(1+sigma(CR_sa,CR_a,CR_sb,CR_corr,$1))) with filledcurves ls 1 notitle, \
     '+' using 1:(D(SR_a,SR_b,$1)*(1-sigma(SR_sa,SR_a,SR_sb,SR_corr,$1))):(D(SR_a,SR_b,$1)*(1+sigma(SR_sa,SR_a,SR_sb,SR_corr,$1))) with filledcurves ls 2 notitle, \
     '+' using 1:(D(CF_a,CF_b,$1)*(1-sigma(CF_sa,CF_a,CF_sb,CF_corr,$1))):(D(CF_a,CF_b,$1)*(1+sigma(CF_sa,CF_a,CF_sb,CF_corr,$1))) with filledcurves ls 3 notitle, \
     '+' using 1:(D(SF_a,SF_b,$1)*(1-sigma(SF_sa,SF_a,SF_sb,SF_corr,$1))):(D(SF_a,SF_b,$1)*(1+sigma(SF_sa,SF_a,SF_sb,SF_corr,$1))) with filledcurves ls 4 notitle, \
     D(CR_a,CR_b,x) ls 1 notitle, D(SR_a,SR_b,x) ls 2 notitle, D(CF_a,CF_b,x) ls 3 notitle, D(SF_a,SF_b,x) ls 4 notitle, \
     for [i=1:4] sprintf('%s/%s.D', scratch, word('CR SR CF SF', i)) using 1:($2*1e3) with points ls i \
       title word('"C on rubber" "S on rubber" "C on felt" "S on felt"', i)
PLOT
