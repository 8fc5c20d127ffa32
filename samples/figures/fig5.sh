#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 5, the process diagram of a rolling body at one instant: the stored quantities, the currents
# of the momenta that carry energy, and where these fall and are pumped. The width of an arrow is its
# power, from energy-ledger.
#
#   fig5.sh [OPTION]... [T] >fig5.svg         the cylinder on rubber, half a second after v = 0.5 m/s,
#                                             or at another instant T [s]
#   fig5.sh [OPTION]... FILE >fig5.svg        your own run
#
#   --at T             the instant [s] (for your own run the beginning of the free roll)
takes=--at needs='-K 0.5 -R 0.04 -m 1.375'
. "$(dirname "$0")/draw.sh"
if [ "$own" = 1 ] && [ -z "$of_own" ]; then
  own=0 at=${files[0]} files=()
  is_number "$at" || wrong "$at is not a time in seconds; for a run of your own: $needs"
fi
stored=E_trans,E_rot,E,p,L carriers=I_pH,I_pN,I_LH,I_LN,F_G,vP_H,vP_V
instant 0.5 $stored,$carriers,I_E1,I_E2,P_T1,P_R1,P_R2,P_T2,P_T3,P_T4,P_diss,Pi_S
title='Fig. 5: the process diagram of a rolling body'
draw 960 680 "W = 960.0; H = 680.0; $now" <<'PLOT'
# All in pixels. A stage is a box in which a carrier falls or is pumped; what the body stores stands in
# the containers above.
unset border; unset tics; unset key
set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0
set xrange [0:W]; set yrange [0:H]
pixels = 72/P_diss   # for a watt
y = 300; wide = 136; high = 170; stored = y + high/2 + 130
x(stage) = 84 + 264*(stage - 1)
# All powers are in one unit.
scale = P_diss < 1 ? 1e3 : P_diss < 1e3 ? 1 : 1e-3
watt = P_diss < 1 ? 'mW' : P_diss < 1e3 ? 'W' : 'kW'
power(p) = (p < 0 ? '−' : '').sprintf('%.2f', scale*abs(p))
# From the numbers that the others say, so that what is read at a stage adds up in its last digit.
said(p) = floor(100*scale*p + 0.5)/(100*scale)
# An arrow of energy, to the right or down: a shaft as wide as its power, and a head a little wider.
shape = '%g,%g to %g,%g to %g,%g to %g,%g to %g,%g to %g,%g to %g,%g to %g,%g'
across(x1, x2, power) = (w = pixels*power/2, sprintf(shape, \
  x1, y + w, x2 - 20, y + w, x2 - 20, y + w + 7, x2, y, x2 - 20, y - w - 7, x2 - 20, y - w, \
  x1, y - w, x1, y + w))
down(x, y1, y2, power) = (w = pixels*power/2, sprintf(shape, \
  x - w, y1, x - w, y2 + 20, x - w - 7, y2 + 20, x, y2, x + w + 7, y2 + 20, x + w, y2 + 20, \
  x + w, y1, x - w, y1))
energy(outline) = 'set object polygon from '.outline. \
                  ' fc rgb 0xF5D0A0 fs solid 1 border rgb "black" lw 1'
eval energy(across(x(1) + wide/2, x(2) - wide/2, P_T1))
eval energy(across(x(2) + wide/2, x(3) - wide/2, P_R2))
eval energy(across(x(3) + wide/2, x(4) - wide/2, I_E2))
eval energy(down(x(1), stored - 30, y + high/2, P_T1 + I_E1))
eval energy(down(x(2), stored - 30, y + high/2, P_R2 + P_R1))
eval energy(down(x(4), y - high/2, y - high/2 - 100, P_diss))
set object rectangle from 4, 134 to x(3) + wide/2 + 8, H - 44 fs empty border rgb grey lw 1 dt 2
set label 'rolling body' at x(3) + wide/2, H - 60 right textcolor rgb 0x606060
set label cut(system('cat name'), 40).sprintf(" at t = %s s:  v = %.3f m/s,  D = %.2f mm", \
  number(t), v, 1e3*D) at W/2, H - 22 center noenhanced
do for [s = 1:4] {
  set object rectangle center x(s), y size wide, high fc rgb 'white' fs solid 1 \
    border rgb black lw 2
}
# The containers: E has two parts, which flow out with p_x and with L.
container = ' fc rgb 0xDCE9F5 fs solid 1 border rgb black lw 1'
set object rectangle from x(1) - 66, stored + 34 to x(2) + 66, stored + 62 \
  fc rgb 0xF5D0A0 fs solid 1 border rgb black lw 1
set label 'E = E_{trans} + E_{rot} = '.quantity(E, 'J') at (x(1) + x(2))/2, stored + 48 center
do for [s = 1:3] { eval sprintf('set object rectangle center %g,%g size 132,64', x(s), stored + 2).container }
set label "p_x = ".quantity(p, 'N s')."\nE_{trans} = ".quantity(E_trans, 'J') at x(1), stored + 12 center
set label "L = ".quantity(L, 'N m s')."\nE_{rot} = ".quantity(E_rot, 'J') at x(2), stored + 12 center
set label "p_y = 0\n" at x(3), stored + 12 center
set label power(said(P_T1) + said(I_E1)) at x(1) + 44, stored - 60 left
set label power(said(P_R2) - said(P_T1)) at x(2) + 36, stored - 60 left
# Released above an arrow, used below it.
between(s) = (x(s) + x(s + 1))/2
named(name, p) = name."\n".power(p)
set label named('P_{T1}', P_T1) at between(1) - 6, y + 72 center font ',13'
set label named('P_{R1}', P_R1) at between(1) + 1, y - 56 center font ',13'
set label named('P_{R2}', P_R2) at between(2) - 6, y + 78 center font ',13'
set label named('P_{T2}', P_T2) at between(2) + 1, y - 62 center font ',13'
set label named('I_{E2}', I_E2) at between(3) + 4, y + 78 center font ',13'
set label "P_{diss} = P_{T3} + P_{T4}\n= ".power(said(I_E1) + said(I_E2)) at x(4) - 58, y - high/2 - 62 right
# The mat at its temperature produces entropy: the source is a dot in a circle.
source = y - high/2 - 120
set object circle at x(4), source size 11 fs empty border rgb vermilion lw 2
set object circle at x(4), source size 2.5 fc rgb vermilion fs solid 1 noborder
set label sprintf("Π_S = P_{diss}/T = %s\nin the mat, at T = 293 K", quantity(Pi_S, 'W/K')) \
  at x(4) - 20, source + 4 right
# The carriers in their stages, from level to level, each with its current.
set style arrow 1 head filled size 10, 20 lw 2 lc rgb vermilion
set style arrow 2 head filled size 10, 20 lw 2 lc rgb blue
set style arrow 3 head filled size 8, 20 lw 1
top = y + 35; low = y - 22; current = y - 68
title(s) = sprintf('set label at %g, %g center ', x(s), y + 66)
eval title(1).'"p_x"'; eval title(2).'"L"'; eval title(3).'"p_y"'; eval title(4).'"the mat"'
set arrow from x(1) - 58, top to x(1) - 58, low as 1
set label quantity(v, 'm/s') at x(1) - 46, top left font ',13'
set label quantity(vP_H, 'm/s') at x(1) - 46, low left font ',13'
set label 'I_{pH} = '.quantity(I_pH, 'N') at x(1), current center font ',12'
set arrow from x(2) - 58, low to x(2) - 58, top as 2
set arrow from x(2) + 58, top to x(2) + 58, low as 1
set label sprintf('ω = %.3g rad/s', v/R) at x(2), top center font ',13'
set label '0' at x(2), low center font ',13'
set label 'I_{LN} = '.quantity(I_LN, 'N m') at x(2), current center font ',12'
set label 'I_{LH} = '.quantity(I_LH, 'N m') at x(2), current + 20 center font ',12'
set arrow from x(3) - 58, low to x(3) - 58, top as 2
set label '0' at x(3) - 46, top left font ',13'
set label quantity(vP_V, 'm/s') at x(3) - 46, low left font ',13'
set label 'I_{pN} = '.quantity(I_pN, 'N') at x(3), current center font ',12'
# Gravity takes off at rest what comes in of p_y.
set arrow from x(3), y + high/2 to x(3), stored - 32 as 3
set label 'F_G = '.quantity(F_G, 'N').":\ngravity takes away\nthe p_y that comes in" at x(3) - 10, stored - 56 right font ',12'
set label "p_x and p_y\nfall to 0:" at x(4), top + 4 center font ',13'
set label "P_{T3} = ".power(P_T3)."\nP_{T4} = ".power(P_T4) at x(4), y - 4 center font ',13'
set label 'all dissipated' at x(4), current center font ',12'
# I_E1 is too narrow to be drawn as wide as it is.
corner = x(4) - wide/2 - 22; under = y - high/2 - 42
set arrow from x(1), y - high/2 to x(1), under nohead lw 1
set arrow from x(1), under to corner, under nohead lw 1
set arrow from corner, under to corner, y - 50 nohead lw 1
set arrow from corner, y - 50 to x(4) - wide/2, y - 50 as 3
set label 'I_{E1} = '.power(I_E1).', not drawn to scale' at x(1) + 10, under + 14 left
# The key.
unit = 10**floor(log10(P_diss/1.5))
set object rectangle from 30, 88 to 60, 88 + unit*pixels fc rgb 0xF5D0A0 fs solid 1 border rgb black lw 1
set label sprintf('an arrow of %g %s; all powers are in %s', scale*unit, watt, watt) at 72, 88 + unit*pixels/2 left
set arrow from 45, 80 to 45, 50 as 1
set label 'falls from level to level, and releases energy' at 72, 65 left
set arrow from 45, 12 to 45, 42 as 2
set label 'is pumped from level to level, and takes energy up' at 72, 27 left
plot NaN notitle
PLOT
