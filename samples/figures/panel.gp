# SPDX-License-Identifier: GPL-3.0-or-later
# A panel of width by height pixels at left, bottom, for Figs. 2 and 3: sets the axes and what both
# draw. Lengths are in fortieths of the radius from the lowest point of the body, millimetres for the
# cylinder of the paper; the lower left corner is the point x0, y0, a unit has scale pixels, and the
# picture has W by H.
unset arrow; unset label; unset object; unset tics; unset key
set lmargin at screen left/W; set rmargin at screen (left + width)/W
set bmargin at screen bottom/H; set tmargin at screen (bottom + height)/H
x1 = x0 + 1.0*width/scale; set xrange [x0:x1]
y1 = y0 + 1.0*height/scale; set yrange [y0:y1]
r = 40; d = r*D/R; A = sqrt(1-(D/R)**2); p = r*(1-A)   # P is at d, p
# The mat is pressed in under the body, in as far ahead of P as behind it, so that P is in the middle;
# it bulges ahead and has not come back behind. This outline is a sketch, not the result of a model.
depth(x) = r - sqrt(r**2 - min(abs(x), r)**2)
reach = min(max(0.35*r, 1.2*d), 0.9*r - d); back = max(reach - d, 0.05*r); level = 0.75*depth(reach + d)
mat(x) = x < -back ? level + (depth(back) - level)*exp((x + back)/(0.2*r)) : x <= reach + d ? depth(x) : \
  level + (depth(reach + d) - level)*exp(-((x - reach - d)/(0.15*r))**2)
outline(x) = abs(x) <= r ? depth(x) : NaN
set samples 1001; set style fill solid noborder
set style arrow 1 front head filled size screen 0.012, 18 lw 2.5   # forces, velocities
set style arrow 2 front heads filled size screen 0.008, 18 lw 1    # lengths
set style arrow 3 front nohead lw 0.8 dt 2   # construction lines (svg forgets dashes at width 2)
set style arrow 4 front nohead lw 2.5
set style arrow 5 front head filled size screen 0.008, 18 lw 1.2   # axes, senses of rotation
set style arrow 6 front nohead lw 1
# The panel of the whole body: the axes; and sense(s, t1, t2), the head of an arc about the centre at s
# radii from one angle to another (from the vertical, clockwise).
on(s, t) = sprintf('%g,%g', s*r*sin(t), r + s*r*cos(t))
axes = 'set arrow from -54,-37 to -44,-37 as 5; set arrow from -54,-37 to -54,-27 as 5; '. \
       'set label "x" at -43,-37; set label "y" at -54,-24 center'
sense(s, t1, t2) = 'set arrow from '.on(s, t2 - 0.04*sgn(t2 - t1)).' to '.on(s, t2).' as 5; '
# broken(x, y, dx, dy): an arrow that is too long for its panel, with a break in it.
broken(x, y, dx, dy, color) = (e = 0.03*dy, s = abs(e), sprintf( \
  'set arrow from %g,%g to %g,%g as 4 lc rgb %d; set arrow from %g,%g to %g,%g as 1 lc rgb %d; '. \
  'set arrow from %g,%g to %g,%g as 6; set arrow from %g,%g to %g,%g as 6', \
  x, y, x + 0.5*dx, y + 0.5*dy - e, color, x + 0.5*dx, y + 0.5*dy, x + dx, y + dy, color, \
  x + 0.5*dx - s, y + 0.5*dy - e - s/3, x + 0.5*dx + s, y + 0.5*dy - e + s/3, \
  x + 0.5*dx - s, y + 0.5*dy - s/3, x + 0.5*dx + s, y + 0.5*dy + s/3))
