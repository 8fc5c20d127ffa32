#!/bin/bash
# The energy of a roll against time: what is stored, what is dissipated, and their sum, which stays. `make figures/energy.svg`
# Run in samples/ with the tools on PATH; writes gnuplot's output for the terminal in $1 (svg or pngcairo) to standard output.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
simulate --scene CR.toml --columns t,v,D | energy-ledger --scene CR.toml >"$scratch/energy"
cd figures
gnuplot -e "file = '$scratch/energy'; set terminal $1 size 800,500 font 'sans,12'" - <<'PLOT'
load 'style.gp'
set xlabel 'time t / s'; set ylabel 'energy / J'; set yrange [0:0.3]; set key at graph 0.98, 0.72
plot file using 1:4 with lines ls 1 title 'translational', file using 1:($4+$5) with lines ls 2 title 'and rotational', \
     file using 1:13 with lines ls 3 title 'dissipated', file using 1:($4+$5+$13) with lines lc rgb 'black' lw 2 title 'all of it'
PLOT
