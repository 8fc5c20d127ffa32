#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 5, the process diagram of the cylinder on rubber at one instant: momentum and angular
# momentum fall and are pumped, and every arrow of energy is as wide as energy-ledger computes its
# power. `make figures/fig5.svg`; an operand is another instant [s]: samples/figures/fig5.sh 1.5
# >fig5.svg
. "$(dirname "$0")/draw.sh"
instant=${1:-0.5}
now=$(printf 't\n%s\n' "$instant" | simulate --scene CR.toml --exact --at - |
  energy-ledger --scene CR.toml --exact | assignments)
title='Fig. 5: the process diagram of the cylinder on rubber'
draw 900 600 "W = 900.0; H = 600.0; $(scene CR.toml) $now" <<'PLOT'
# All in pixels. A stage is a box in which a carrier falls or is pumped; what is stored flows in
# from above.
unset border; unset tics; unset key
set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0
set xrange [0:W]; set yrange [0:H]
pixels = 72/P_diss   # for a watt
# The velocity of P: each current of energy over that of its momentum.
F_H = m*a; F_N = P_R2*R/(v*D); v_H = -I_E1/F_H; v_V = -I_E2/F_N
y = 300; wide = 128; high = 170; stored = y + high/2 + 75
x(stage) = 80 + 246*(stage - 1)
mW(p) = (p < 0 ? '−' : '').sprintf('%.2f', 1e3*abs(p))
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
eval energy(down(x(1), stored, y + high/2, P_T1 + I_E1))
eval energy(down(x(2), stored, y + high/2, P_R2 + P_R1))
eval energy(down(x(4), y - high/2, y - high/2 - 100, P_diss))
set object rectangle from 6, 150 to x(3) + wide/2 + 8, H - 52 fs empty border rgb grey lw 1 dt 2
set label 'rolling body' at x(3) + wide/2, H - 72 right textcolor rgb 0x606060
set label sprintf("The cylinder on rubber at t = %s s:  v = %.3f m/s,  D = %.2f mm", \
  number(t), v, 1e3*D) at W/2, H - 25 center
do for [s = 1:4] {
  set object rectangle center x(s), y size wide, high fc rgb 'white' fs solid 1 \
    border rgb black lw 2
}
do for [s = 1:2] {
  set object rectangle center x(s), stored + 27 size 110, 54 fc rgb 0xDCE9F5 fs solid 1 \
    border rgb black lw 1
}
set label sprintf("E_{trans}\n%.4f J", E_trans) at x(1), stored + 36 center
set label sprintf("E_{rot}\n%.4f J", E_rot) at x(2), stored + 36 center
# From the numbers that the others say, so that what is read at a stage adds up in its last digit.
said(p) = floor(1e5*p + 0.5)/1e5
set label mW(said(P_T1) + said(I_E1)) at x(1) + 48, stored - 32 left
set label mW(said(P_R2) - said(P_T1)) at x(2) + 36, stored - 32 left
# Released above an arrow, used below it.
between(s) = (x(s) + x(s + 1))/2
power(name, p) = name."\n".mW(p)
set label power('P_{T1}', P_T1) at between(1) - 6, y + 72 center font ',13'
set label power('P_{R1}', P_R1) at between(1) + 1, y - 56 center font ',13'
set label power('P_{R2}', P_R2) at between(2) - 6, y + 78 center font ',13'
set label power('P_{T2}', P_T2) at between(2) + 1, y - 62 center font ',13'
set label power('I_{E2}', I_E2) at between(3) + 1, y + 78 center font ',13'
set label "P_{diss} = I_{E1} + I_{E2}\n= ".mW(said(I_E1) + said(I_E2)) at x(4) - 58, y - high/2 - 72 right
# The mat, at 293 K, produces entropy.
set object circle at x(4), y - high/2 - 122 size 11 fs empty \
  border rgb vermilion lw 2
set label sprintf("Π_S = P_{diss}/T = %.2f mW/K\nin the mat, at T = 293 K", 1e3*P_diss/293) \
  at x(4) - 20, y - high/2 - 118 right
# The carriers in their stages, from level to level.
set style arrow 1 head filled size 10, 20 lw 2 lc rgb vermilion
set style arrow 2 head filled size 10, 20 lw 2 lc rgb blue
top = y + 35; low = y - 45
title(s) = sprintf('set label at %g, %g center ', x(s), y + 66)
eval title(1).'"p_x"'; eval title(2).'"L"'; eval title(3).'"p_y"'; eval title(4).'"the mat"'
set arrow from x(1) - 54, top to x(1) - 54, low as 1
set label sprintf('%.3f m/s', v) at x(1) - 42, top left font ',13'
set label sprintf('%.2g mm/s', 1e3*v_H) at x(1) - 42, low left font ',13'
set arrow from x(2) - 54, low to x(2) - 54, top as 2
set arrow from x(2) + 54, top to x(2) + 54, low as 1
set label sprintf('ω = %.3g /s', v/R) at x(2), top center font ',13'
set label '0' at x(2), low center font ',13'
set arrow from x(3) - 54, low to x(3) - 54, top as 2
set label '0' at x(3) - 42, top left font ',13'
set label sprintf('−%.2g mm/s', -1e3*v_V) at x(3) - 42, low left font ',13'
set label "p_x and p_y\nfall to 0,\nall that they\ncarry is\ndissipated" \
  at x(4), top center font ',13'
# I_E1 is too narrow to be drawn as wide as it is.
corner = x(4) - wide/2 - 22; under = y - high/2 - 42
set arrow from x(1), y - high/2 to x(1), under nohead lw 1
set arrow from x(1), under to corner, under nohead lw 1
set arrow from corner, under to corner, y - 65 nohead lw 1
set arrow from corner, y - 65 to x(4) - wide/2, y - 65 head filled size 8, 20 lw 1
set label sprintf('I_{E1} = %.2f: too little to be drawn to scale', 1e3*I_E1) \
  at x(1) + 10, under + 14 left
# The key.
set object rectangle from 30, 95 to 60, 95 + 0.1*pixels fc rgb 0xF5D0A0 fs solid 1 \
  border rgb black lw 1
set label 'an arrow of 100 mW; all powers are in mW' at 72, 95 + 0.05*pixels left
set arrow from 45, 82 to 45, 52 as 1
set label 'falls from level to level, and releases energy' at 72, 67 left
set arrow from 45, 12 to 45, 42 as 2
set label 'is pumped from level to level, and takes energy up' at 72, 27 left
plot NaN notitle
PLOT
