# SPDX-License-Identifier: GPL-3.0-or-later
# A panel of width by height pixels at left, bottom. Its lower left corner is the point x0, y0 [mm
# from the lowest point of the body]; a millimetre has scale pixels, and the picture has W by H. For
# Figs. 2 and 3: sets the axes and what both draw.
unset arrow; unset label; unset object; unset tics; unset key
set lmargin at screen left/W; set rmargin at screen (left + width)/W
set bmargin at screen bottom/H; set tmargin at screen (bottom + height)/H
x1 = x0 + 1.0*width/scale; set xrange [x0:x1]
y1 = y0 + 1.0*height/scale; set yrange [y0:y1]
r = 1e3*R; d = 1e3*D; A = sqrt(1-(D/R)**2); p = r*(1-A)   # P is at d, p
# The mat follows the outline of the body from the lowest point to P, and falls off beyond in as
# much again: this part is a sketch, not the result of a model.
outline(x) = abs(x) <= r ? r - sqrt(r**2 - x**2) : NaN
mat(x) = x < 0 ? 0 : x < d ? outline(x) : x < 2*d ? p*(1 + cos(pi*(x/d - 1)))/2 : 0
set samples 1001; set style fill solid noborder
set style arrow 1 front head filled size screen 0.012, 18 lw 2.5   # forces, velocities
set style arrow 2 front heads filled size screen 0.008, 18 lw 1    # lengths
set style arrow 3 front nohead lw 0.8 dt 2   # construction lines (svg forgets dashes at width 2)
set style arrow 4 front nohead lw 2.5
set style arrow 5 front head filled size screen 0.008, 18 lw 1.2   # axes, the sense of rotation
set style arrow 6 front nohead lw 1
# The panel of the whole body: the axes, and the sense of the rotation, an arc from one angle to
# another about the centre (from the vertical, clockwise).
turn(t) = sprintf('%g,%g', 1.13*r*sin(t), r + 1.13*r*cos(t))
axes = 'set arrow from -54,-33 to -44,-33 as 5; set arrow from -54,-33 to -54,-23 as 5; '. \
       'set label "x" at -43,-33; set label "y" at -54,-20 center'
sense = 'set arrow from '.turn(-0.58).' to '.turn(-0.54).' as 5; '. \
        'set label "ω" at '.turn(-0.85).' right offset -0.4, 0.6'
# broken(x, from, to): a vertical arrow that is too long for its panel, with a break in it.
broken(x, y1, y2) = (m = (y1 + y2)/2, e = 0.04*(y2 - y1), s = abs(e), sprintf( \
  'set arrow from %g,%g to %g,%g as 4 lc rgb vermilion; '. \
  'set arrow from %g,%g to %g,%g as 1 lc rgb vermilion; '. \
  'set arrow from %g,%g to %g,%g as 6; set arrow from %g,%g to %g,%g as 6', \
  x, y1, x, m - e/2, x, m + e/2, x, y2, \
  x - s, m - e/2 - s/3, x + s, m - e/2 + s/3, x - s, m + e/2 - s/3, x + s, m + e/2 + s/3))
