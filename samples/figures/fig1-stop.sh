#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 1 near the stop: the bodies roll backwards for a moment before they rest. A law D(v) alone
# does not show this; a bulge with a memory of a rolled length does. For the sample the length is the one
# that made the run; for your own run roll-back.sh measures it, and its result stands below.
#
#   fig1-stop.sh [OPTION]... [FILE] >fig1-stop.svg      the cylinder on rubber, or your own run
. "$(dirname "$0")/draw.sh"
prepare CR
one_run
[ $column = x ] || wrong 'needs positions'
fit --route position rolls
body 1
roll() { simulate ${quiet:+-q} --law fit1 "${body[@]}" --columns t,x,v "$@"; }
roll >law
# Times are from the stop that the law alone predicts; positions from the place of rest, for the
# run the mean of its last second.
stop=$(columns law t | tail -n 1) end=$(columns readings t | tail -n 1)
roll --until "$end" --dt 0.005 >law
differentiate -q -c x readings >moving && columns moving t x v >raw
"$samples/roll-back.sh" -K "$K" -R "$R" readings >back 2>said || { cat said >&2 && exit 2; }
memory=0.5 damping=0.02 of_memory='0.5 mm (given, not fitted)'
if [ "$own" -gt 0 ]; then  # a memory is one of a v^b
  memory=$([ "$law" ] || sed -n 's/.* memory of \([0-9.]*\) .*/\1/p' back) damping=0 of_memory="$memory mm"
fi
cp law memory  # for gnuplot, which looks for it where it is not drawn, too
[ -z "$memory" ] || roll --until "$end" --dt 0.005 --memory "${memory}e-3" --damping "$damping" >memory
rest=$(columns moving t x | awk -v end="$end" '$1 > end - 1 { sum += $2; n++ } END { print sum / n }'
  tail -n 1 law | cut -f 2
  tail -n 1 memory | cut -f 2)
{ printf 'The roll backwards: ' && tr '\n' ' ' <back; } | sed 's/+-/±/g; s/, goes/,@goes/; s/; as/;@as/; s/: of/:@of/' | tr @ '\n' >note
title='Fig. 1, the stop: velocity and position near the stop, with the roll backwards'
draw 520 740 "remembers = ${#memory}; of_memory = '$of_memory'; stop = $stop; rest = '${rest//$'\n'/ }'" <<'PLOT'
set multiplot layout 2,1 margins 0.15,0.98,0.17,0.98 spacing 0.1
set xrange [-0.52:0.82]; set xzeroaxis lt -1 lw 0.5
set xlabel 'time after the stop that the law D(v) alone predicts / s'
after(t) = t - stop
sign = system("awk '/^[^#]/ { print ($3 < 0 ? -1 : 1); exit }' law") + 0
mm(x, i) = 1e3*sign*(x - word(rest, i))
name = own ? name(1) : label[1]
set ylabel 'velocity v / (mm/s)' offset 0.7, 0; set yrange [-22:110]
plot 'raw' using (after($1)):(1e3*sign*$3) with points ls 1 ps 0.6 title name.': differences of the positions' noenhanced, \
     for [i=1:(remembers > 0)] 'memory' using (after($1)):(1e3*sign*$3) with lines ls 1 \
       title 'with a memory of '.of_memory, \
     'law' using (after($1)):(1e3*sign*$3) with lines ls 12 title 'fitted law alone'
set ylabel 'distance from rest / mm' offset -1, 0; set yrange [-8:2]; set key bottom right
set label 1 system('cat note') at screen 0.02, screen 0.06 left font ',12'
plot 'raw' using (after($1)):(mm($2, 1)) with points ls 1 ps 0.6 title name.': the positions' noenhanced, \
     for [i=1:(remembers > 0)] 'memory' using (after($1)):(mm($2, 3)) with lines ls 1 notitle, \
     'law' using (after($1)):(mm($2, 2)) with lines ls 12 notitle
PLOT
