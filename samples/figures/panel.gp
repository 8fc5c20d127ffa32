# A panel of width by height pixels at left, bottom, whose lower left corner is the point x0, y0 [mm from the lowest point of the
# body]; a millimetre has scale pixels, and the picture has W by H. For Figs. 2 and 3: sets the axes and what both draw.
unset arrow; unset label; unset object; unset tics; unset key
set lmargin at screen left/W; set rmargin at screen (left + width)/W; x1 = x0 + 1.0*width/scale; set xrange [x0:x1]
set bmargin at screen bottom/H; set tmargin at screen (bottom + height)/H; y1 = y0 + 1.0*height/scale; set yrange [y0:y1]
r = 1e3*R; d = 1e3*D; A = sqrt(1-(D/R)**2); p = r*(1-A)   # P is at d, p
# The mat follows the body's outline from the lowest point to P, and falls off beyond in as much again: a sketch, no model tells.
outline(x) = abs(x) <= r ? r - sqrt(r**2 - x**2) : NaN
mat(x) = x < 0 ? 0 : x < d ? outline(x) : x < 2*d ? p*(1 + cos(pi*(x/d - 1)))/2 : 0
set samples 1001; set style fill solid noborder
set style arrow 1 front head filled size screen 0.012, 18 lw 2.5   # forces, velocities
set style arrow 2 front heads filled size screen 0.008, 18 lw 1   # lengths
set style arrow 3 front nohead lw 0.8 dt 2   # lines of the construction (svg forgets dashes at the width of 2)
set style arrow 4 front nohead lw 2.5   # an arrow that leaves the panel
