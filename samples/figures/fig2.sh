#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 2, the forces on the cylinder on rubber at 0.5 m/s, drawn to scale: the shift D is small
# beside the radius, and F_H beside F_N, so that a second panel shows the neighbourhood of P some
# forty times larger. `make figures/fig2.svg`
. "$(dirname "$0")/draw.sh"
now=$(printf 't\n0\n' | simulate --scene CR.toml --exact --at - |
  energy-ledger --scene CR.toml --exact | assignments)
title='Fig. 2: the forces on the cylinder on rubber, to scale'
draw 840 470 "W = 840.0; H = 470.0; $(scene CR.toml) $now" <<'PLOT'
# The forces by the simulated acceleration and by the ledger's P_R2 = (v/R) D F_N; 2 mm a newton.
F_H = m*a; F_N = P_R2*R/(v*D); h = 2*F_H; n = 2*F_N
set multiplot
left = 0; bottom = 0; width = 400; height = 470
x0 = -58; y0 = -36; scale = 3.45; load 'panel.gp'
unset border
eval axes; eval sense
set object 2 circle at 0, r size 1 fc rgb black
set object 3 rectangle front from -0.9, -1.1 to 2.7, 2.3 fc rgb black fs empty lw 1
set arrow from 0, r to 0, r-n as 1 lc rgb blue
set arrow from d, p to d, p+n as 1 lc rgb vermilion
set arrow from 0, r to -r*cos(0.5), r+r*sin(0.5) as 2
set arrow from -15, 2*r+8 to 15, 2*r+8 as 1 lc rgb black
set label 'v = '.number(v).' m/s,  ω = v/R = '.number(v/R).' /s' at 0, 2*r+13 center
set label 'R = '.number(r).' mm' at -10, r+17 left
set label "m g\n".number(F_N).' N' at -3, r-12 right
set arrow from d, p to d+h, p front head filled size screen 0.003, 25 lw 1 lc rgb vermilion
set label 'F_H' at -3.5, 7 right
set label "F_N\n".number(F_N).' N' at d+3, p+20 left
set label 'τ_N = −D F_N = '.number(-1e3*D*F_N).' mN m' at 0, -16 center front
set label 'τ_H = −A R F_H = +'.number(-1e3*A*R*F_H).' mN m' at 0, -24 center front
plot '+' using 1:(-8):(mat($1)) with filledcurves lc rgb pale notitle, \
     [t=0:2*pi] '+' using (r*sin(t)):(r - r*cos(t)) with lines lc rgb black lw 2 notitle, \
     [t=-1.15:-0.55] '+' using (1.13*r*sin(t)):(r + 1.13*r*cos(t)) with lines lc rgb black lw 1.2 \
       notitle
left = 415; bottom = 15; width = 420; height = 440
x0 = -0.7; y0 = -1.1; scale = 125; load 'panel.gp'
set border 15
eval broken(d, p, y1 - 0.2)
set arrow from d, p to d+h, p as 1 lc rgb vermilion
set arrow from 0, -0.35 to d, -0.35 as 2
set arrow from 0, y0 + 0.4 to 0, y1 as 3
set arrow from d, -0.5 to d, p as 3
set arrow from d, p to d-(y1-p)*D/R/A, y1 as 3
set label 'D = '.number(d).' mm' at d/2, -0.48 center front
set label 'F_H = '.number(F_H).' N' at d-0.12, 0.17 right front
set label "F_N\n(too long\nto scale)" at d+0.1, 1.4 left
set label 'P' at d+0.08, -0.1 left front
set label sprintf('P is %.2g mm above the lowest point', p) at 0.5*(x0+x1), -0.95 center front
set label sprintf("to the axis,\n%.2g° off\nthe vertical", asin(D/R)*180/pi) at d-0.16, 1.5 right
set label sprintf("%.0f times\nlarger", 125/3.45) at graph 0.97, 0.95 right
set object 1 circle front at d, p size 0.035 fc rgb black
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
PLOT
