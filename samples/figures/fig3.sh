#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 3, the velocity of P as a point of the body at one instant, to scale. P lies A R below the
# axis and turns about the lowest point: it moves down with (D/R) v and forward with only (1 - A) v. Each
# panel enlarges a part of the one before.
#
#   fig3.sh [OPTION]... [FILE] >fig3.svg      the cylinder on rubber, or your own run
#
#   --at T             the instant [s] (the beginning of the free roll)
takes=--at m=1  # velocities do not depend on it
. "$(dirname "$0")/draw.sh"
instant 0 vP_H,vP_V
title='Fig. 3: the velocity of P as a point of the body, to scale'
draw 840 780 "W = 840.0; H = 780.0; $now" <<'PLOT'
# v has 25 units, for the cylinder of the paper 50 mm for 1 m/s.
u = 25.0; h = u*vP_H/v; f = u*vP_V/v
set multiplot
left = 0; bottom = 290; width = 400; height = 490
x0 = -58; y0 = -42; scale = 3.45; load 'panel.gp'
unset border
eval axes; eval sense(1.13, -1.15, -0.55)
set object 2 circle at 0, r size 1 fc rgb black
set object 3 rectangle front from -0.55*d, -0.68*d to 1.65*d, 1.3*d fc rgb black fs empty lw 1
set arrow from 0, 0 to 2*u, 2*r as 3
set arrow from 0, 2*r to 2*u, 2*r as 1 lc rgb blue
set arrow from 0, r to u, r as 1 lc rgb blue
set arrow from 0, r/2 to u/2, r/2 as 1 lc rgb blue
set arrow from u, r to 52, r as 3; set arrow from d, p to 52, p as 3
set arrow from 47, p to 47, r as 2
set label sprintf('A R = %.4g mm', 1e3*A*R) at 51, r/2 center rotate by 90
set label 'v = '.number(v).' m/s' at -3, r right
set label '2v' at 2*u+2, 2*r left
set label "velocities of points of the body\nω = v/R = ".number(v/R).' rad/s' at 0, 2*r+15 center
set label 'ω' at -1.13*r*sin(0.85), r + 1.13*r*cos(0.85) right offset -0.4, 0.6
set label 'the lowest point is at rest' at 0, -16 center front
set label cut(system('cat name'), 40) at -36, -35 left noenhanced
plot '+' using 1:(-8):(mat($1)) with filledcurves lc rgb pale notitle, \
     [t=0:2*pi] '+' using (r*sin(t)):(r - r*cos(t)) with lines lc rgb black lw 2 notitle, \
     [t=-1.15:-0.55] '+' using (1.13*r*sin(t)):(r + 1.13*r*cos(t)) with lines lc rgb black lw 1.2 \
       notitle
zoom = 200/d
left = 415; bottom = 325; width = 420; height = 440
x0 = -0.43*d; y0 = -d; scale = zoom; load 'panel.gp'
set border 15
set arrow from d, p to d, p+f as 1 lc rgb vermilion
set arrow from 0, -0.2*d to d, -0.2*d as 2
set arrow from 0, y0 + 0.55*d to 0, y1 as 3
set arrow from d, p to d-(y1-p)*D/R/A, y1 as 3
set label 'D = '.number(1e3*D).' mm' at d/2, -0.28*d center front
set label 'v(P)_V = −(D/R) v' at 0.94*d, -0.53*d right front
set label '= '.number(1e3*vP_V).' mm/s' at 0.94*d, -0.65*d right front
set label 'P' at 1.05*d, -0.09*d left front
set label sprintf("to the axis, A R higher,\n%.2g° off the vertical", asin(D/R)*180/pi) \
  at 0.9*d, 0.8*d right
set label sprintf("%.0f times\nlarger", zoom/3.45) at graph 0.97, 0.95 right
set object 1 circle front at d, p size 0.022*d fc rgb black
zoom = 97/p
set object 2 rectangle front from d - 390/zoom, p - 1.5*p to d + 390/zoom, p + 1.4*p fc rgb black fs empty lw 1
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
left = 15; bottom = 15; width = 820; height = 270; scale = zoom
x0 = d - 390/zoom; y0 = -0.7*p; load 'panel.gp'
set border 15
set arrow from d, p to d+h, p as 1 lc rgb vermilion
eval broken(d, p, 0, y0 + 0.12*p - p, vermilion)
set arrow from x0, 0 to x1, 0 as 3
set arrow from d - 90/zoom, 0 to d - 90/zoom, p as 2
set arrow from d - 105/zoom, p to d, p as 3
set label 'R (1 − A) ' at d - 100/zoom, 0.7*p right front
set label '= '.sprintf('%.2g', 1e3*R*(1-A)).' mm ' at d - 100/zoom, 0.4*p right front
set label 'v(P)_H = (1 − A) v = '.number(1e3*vP_H).' mm/s' at d - 24/zoom, 1.6*p left
set label 'v(P)_V (too long to scale)' at d + 15/zoom, y0 + 0.2*p left front
set label 'the level of the lowest point' at x1 - 18/zoom, -0.2*p right front
set label sprintf("%.0f times larger", zoom/3.45) at graph 0.97, 0.93 right
set object 1 circle front at d, p size 4.5/zoom fc rgb black
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
PLOT
