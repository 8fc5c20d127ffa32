#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws Fig. 2, the forces on the body at one instant, to scale. D is small beside the radius, and F_H
# beside F_N; so two panels show the surroundings of P and of the axis about forty times larger. The
# force of the mat, F_S, is closer to the vertical than the line from P to the axis. So it passes ahead
# of the axis and slows both translation and rotation.
#
#   fig2.sh [OPTION]... [FILE] >fig2.svg      the cylinder on rubber, or your own run
#
#   --at T             the instant [s] (the beginning of the free roll)
takes=--at needs='-K 0.5 -R 0.04 -m 1.375'
. "$(dirname "$0")/draw.sh"
instant 0 F_N,F_H,F_S,F_G,tau_N,tau_H,p,L
title='Fig. 2: the forces on a rolling body, to scale'
draw 840 640 "W = 840.0; H = 640.0; $now" <<'PLOT'
# F_N has 27 units, for the cylinder of the paper 2 mm a newton.
P = p; n = 27.0; h = n*F_H/F_N; s = n*F_G/F_N
set multiplot
left = 0; bottom = 60; width = 400; height = 520
x0 = -58; y0 = -42; scale = 3.45; load 'panel.gp'
unset border
eval axes; eval sense(1.13, -1.15, -0.55)
# The arcs of the torques are as long as they are large.
eval sense(1.13, 2.2, 1.1); t_H = 2.2 - 1.1*tau_H/abs(tau_N); eval sense(1.24, t_H, 2.2)
set object 2 circle at 0, r size 1 fc rgb black
set object 3 rectangle front from -0.55*d, -0.68*d to 1.65*d, 1.3*d fc rgb black fs empty lw 1
set arrow from 0, r to 0, r-s as 1 lc rgb blue
set arrow from d, p to d, p+n as 1 lc rgb vermilion
set arrow from 0, r to -r*cos(0.5), r+r*sin(0.5) as 2
set arrow from -15, 2*r+17 to 15, 2*r+17 as 1 lc rgb black
set label 'v = '.number(v).' m/s,  p = '.quantity(P, 'N s') at 0, 2*r+22 center
set label "ω = ".number(v/R)." rad/s\nL = ".quantity(L, 'N m s') at -57, 2*r+9 left
set label 'R = '.number(1e3*R).' mm' at -10, r+17 left
set label "m g\n".quantity(F_G, 'N') at -3, r-12 right
set label "F_N\n".quantity(F_N, 'N') at d+3, p+20 left
set label 'τ_N' at 1.2*r*sin(2.36), r + 1.2*r*cos(2.36) center
set label 'τ_H' at 1.3*r*sin(t_H - 0.1), r + 1.3*r*cos(t_H - 0.1) center
set label 'τ_N = −D F_N = '.quantity(tau_N, 'N m') at 3, -14 center front
set label 'τ_H = −A R F_H = +'.quantity(tau_H, 'N m') at 3, -22 center front
set label 'τ_N + τ_H = '.quantity(tau_N + tau_H, 'N m').': ω falls' at 3, -30 center front
set label cut(system('cat name'), 40) at -56, -42 left noenhanced
plot '+' using 1:(-8):(mat($1)) with filledcurves lc rgb pale notitle, \
     [t=0:2*pi] '+' using (r*sin(t)):(r - r*cos(t)) with lines lc rgb black lw 2 notitle, \
     [t=-1.15:-0.55] '+' using (1.13*r*sin(t)):(r + 1.13*r*cos(t)) with lines lc rgb black lw 1.2 \
       notitle, \
     [t=1.1:2.2] '+' using (1.13*r*sin(t)):(r + 1.13*r*cos(t)) with lines lc rgb vermilion lw 1.2 \
       notitle, \
     [t=t_H:2.2] '+' using (1.24*r*sin(t)):(r + 1.24*r*cos(t)) with lines lc rgb vermilion lw 1.2 \
       notitle
# The line of F_S passes the level of the axis at x_S.
x_S = d + A*r*F_H/F_N; zoom = 200/d
left = 415; bottom = 15; width = 420; height = 400
x0 = -0.43*d; y0 = -0.62*d; scale = zoom; load 'panel.gp'
set border 15
long = y1 - p - 0.08*d
eval broken(d, p, 0, 0.72*long, vermilion)
eval broken(d, p, long*F_H/F_N, long, green)
set arrow from d, p to d+h, p as 1 lc rgb vermilion
set arrow from 0, -0.2*d to d, -0.2*d as 2
set arrow from 0, y0 + 0.15*d to 0, y1 as 3
set arrow from d, -0.3*d to d, y1 as 3
set arrow from d, p to d-(y1-p)*D/R/A, y1 as 3
set label 'D = '.number(1e3*D).' mm' at d/2, -0.28*d center front
set label 'F_H = '.quantity(F_H, 'N') at d-0.08*d, 0.11*d right front
set label "F_N (too long\nto scale)" at 1.06*d, 0.5*d left
set label "F_S = ".quantity(F_S, 'N').sprintf(",\n%.2g° off\nthe vertical", atan2(-F_H, F_N)*180/pi) at 1.06*d, 1.2*d left \
  textcolor rgb green
set label 'P' at 1.05*d, -0.06*d left front
set label sprintf('P is %.2g mm above the lowest point', 1e3*R*(1-A)) at 0.5*(x0+x1), -0.52*d center front
set label sprintf("to the axis,\n%.2g° off\nthe vertical", asin(D/R)*180/pi) at 0.9*d, 1.0*d right
set label sprintf("%.0f times\nlarger", zoom/3.45) at graph 0.03, 0.95 left
set object 1 circle front at d, p size 0.022*d fc rgb black
plot '+' using 1:(y0):(mat($1)) with filledcurves lc rgb pale notitle, \
     '+' using 1:(outline($1)) with lines lc rgb black lw 2 notitle
left = 415; bottom = 430; width = 420; height = 195
y0 = r - 0.55*d; load 'panel.gp'
set border 15
set arrow from x_S + (y0 - r)*F_H/F_N, y0 to x_S + (y1 - r)*F_H/F_N, y1 as 4 lc rgb green
set arrow from d, r - 0.25*d to d, y1 as 3
set arrow from 0, y0 to 0, y1 as 3
set arrow from -(y0 - r)*D/R/A, y0 to -(y1 - r)*D/R/A, y1 as 3
set arrow from 0, r - 0.2*d to x_S, r - 0.2*d as 2
set label 'the axis' at -0.05*d, r right front
set label 'the line of F_S, '.number(1e3*x_S*R/r).' mm ahead' at x_S + 0.06*d, r - 0.42*d left \
  textcolor rgb green
set label 'the line of F_N' at 1.04*d, r + 0.2*d left
set object 1 circle front at 0, r size 0.022*d fc rgb black
plot NaN notitle
PLOT
