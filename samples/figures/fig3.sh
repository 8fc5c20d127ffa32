#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fig. 3, the velocity of P as a point of the body, drawn to scale for the cylinder on rubber at
# 0.5 m/s: P turns about the lowest point, so it moves down with (D/R) v and forward with (1 - A) v
# only. Each panel is a part of the one before. `make figures/fig3.svg`
. "$(dirname "$0")/draw.sh"
now=$(printf 't\n0\n' | simulate --scene CR.toml --exact --at - |
  energy-ledger --scene CR.toml --exact | assignments)
title='Fig. 3: the velocity of P as a point of the body, to scale'
draw 840 780 "W = 840.0; H = 780.0; $(scene CR.toml) $now" <<'PLOT'
# The velocity of P by the ledger: each current of energy over its current of momentum; 50 mm for
# 1 m/s.
F_H = m*a; F_N = P_R2*R/(v*D); v_H = -I_E1/F_H; v_V = -I_E2/F_N; h = 50*v_H; f = 50*v_V; u = 50*v
set multiplot
left = 0; bottom = 310; width = 400; height = 470
x0 = -58; y0 = -36; scale = 3.45; load 'panel.gp'
unset border
eval axes; eval sense
set object 2 circle at 0, r size 1 fc rgb black
set object 3 rectangle front from -0.9, -1.1 to 2.7, 2.3 fc rgb black fs empty lw 1
set arrow from 0, 0 to 2*u, 2*r as 3
set arrow from 0, 2*r to 2*u, 2*r as 1 lc rgb blue
set arrow from 0, r to u, r as 1 lc rgb blue
set arrow from 0, r/2 to u/2, r/2 as 1 lc rgb blue
set label 'v = '.number(v).' m/s' at -3, r right
set label '2v' at 2*u+2, 2*r left
set label "velocities of points of the body\nω = v/R = ".number(v/R).' /s' at 0, 2*r+17 center
set label 'the lowest point is at rest' at 0, -16 center front
plot '+' using 1:(-8):(mat($1)) with filledcurves lc rgb pale notitle, \
     [t=0:2*pi] '+' using (r*sin(t)):(r - r*cos(t)) with lines lc rgb black lw 2 notitle, \
     [t=-1.15:-0.55] '+' using (1.13*r*sin(t)):(r + 1.13*r*cos(t)) with lines lc rgb black lw 1.2 \
       notitle
left = 415; bottom = 325; width = 420; height = 440
x0 = -0.7; y0 = -1.6; scale = 125; load 'panel.gp'
set border 15
set arrow from d, p to d, p+f as 1 lc rgb vermilion
set arrow from 0, -0.35 to d, -0.35 as 2
set arrow from 0, y0 + 0.9 to 0, y1 as 3
set arrow from d, p to d-(y1-p)*D/R/A, y1 as 3
set label 'D = '.number(d).' mm' at d/2, -0.48 center front
set label 'v(P)_V = −(D/R) v' at d-0.1, -0.85 right front
set label '= '.number(1e3*v_V).' mm/s' at d-0.1, -1.05 right front
set label 'P' at d+0.08, -0.14 left front
set label sprintf("to the axis,\n%.2g° off\nthe vertical", asin(D/R)*180/pi) at d-0.16, 1.2 right
set label sprintf("%.0f times\nlarger", 125/3.45) at graph 0.97, 0.95 right
set object 1 circle front at d, p size 0.035 fc rgb black
set object 2 rectangle front from d-0.13, p-0.05 to d+0.13, p+0.045 fc rgb black fs empty lw 1
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
left = 15; bottom = 15; width = 820; height = 290; scale = 3000
x0 = d-0.13; y0 = p-0.055; load 'panel.gp'
set border 15
set arrow from d, p to d+h, p as 1 lc rgb vermilion
eval broken(d, p, y0 + 0.004)
set arrow from x0, 0 to x1, 0 as 3
set arrow from d-0.03, 0 to d-0.03, p as 2
set arrow from d-0.035, p to d, p as 3
set label 'R (1 − A) ' at d-0.033, 0.7*p right front
set label '= '.sprintf('%.2g', p).' mm ' at d-0.033, 0.4*p right front
set label 'v(P)_H = (1 − A) v = '.number(1e3*v_H).' mm/s' at d-0.008, p+0.02 left
set label 'v(P)_V (too long to scale)' at d+0.005, p-0.048 left front
set label 'the level of the lowest point' at x1-0.006, -0.008 right front
set label sprintf("%.0f times larger", 3000/3.45) at graph 0.97, 0.95 right
set object 1 circle front at d, p size 0.0015 fc rgb black
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
PLOT
