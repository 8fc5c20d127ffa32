#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# report.sh FIGURES [WORK-PRECISION] >report.html: makes one page with Table 1, the energy check and the
# figures. FIGURES is a folder with the SVGs of samples/figures; if it has the manual pages in man/, the
# page links them. WORK-PRECISION is a folder with the SVGs of `make work-precision`. `make report` does
# all of this.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
[ $# -gt 0 ] && [ $# -le 2 ] || wrong 'say the folder of the figures, and that of work-precision if it was run'
for folder; do [ -d "$folder" ] || wrong "$folder is no folder"; done
figures=$(cd "$1" && pwd)
measured=''
[ $# -lt 2 ] || measured=$(cd "$2" && pwd)
cd "$(dirname "$0")"
make_scratch
./table1.sh >"$scratch/table1" ||
  echo "report: table1.sh finds a value too far off, or an open balance; see the page" >&2

# figure FILE TITLE COMMAND: the picture in the page, and the caption from standard input. The names
# in the picture get its own name in front, for a name may stand only once in a page.
figure() {
  local name width
  name=$(basename "$1" .svg)
  width=$(sed -n 's/^ width="\([0-9]*\)".*/\1/p' "$1")
  printf '<figure id="%s">\n<a class="back" href="#_">back to the page</a>\n' "$name"
  printf '<a href="#%s" title="the figure alone">\n' "$name"
  sed -e '/^<?xml/d; /^<desc>/d; s/<title>[^<]*<\/title>//; s/^ width="[0-9]*" height="[0-9]*"$//' \
    -e "s/ id=\([\"']\)/ id=\1$name-/g; s/href='#/href='#$name-/g; s/url(#/url(#$name-/g" \
    -e "s/^<svg *$/<svg role=\"img\" aria-label=\"$2\" style=\"--width: ${width}px\"/" "$1"
  printf '</a>\n<figcaption><b>%s.</b> %s <code>%s</code></figcaption>\n</figure>\n' "$2" "$(cat)" "$3"
}
drawn() { figure "$figures/$1.svg" "$2" "make figures/$1.svg"; }

# table TITLE: that section of table1.sh; its cells are two blanks apart, a line without an indent
# is a heading within it.
table() {
  awk -v title="$1" '
    function cell(text, tag) {
      gsub(/\+-/, "±", text); sub(/^-/, "−", text); sub(/ - /, " − ", text)
      gsub(/1e-3/, "10<sup>−3</sup>", text)
      return "<" tag ">" text "</" tag ">" }
    index($0, title) == 1 { inside = 1; print "<div class=\"wide\"><table>"; next }
    !inside || (/^$/ && !rows) { next }
    /^$/ { exit }
    { n = split(substr($0, 3), part, /  +/); line = ""
      if (!/^  /) line = "<th colspan=\"5\">" $0 "</th>"
      else for (i = 1; i <= n; i++)
        line = line cell(part[i], part[1] ~ /^(route|run|method)$/ ? "th" : "td")
      print "<tr>" line "</tr>"; rows++ }
    END { print "</table></div>" }' "$2" |
    sed -e 's/D_\([A-Za-z]*\)/D<sub>\1<\/sub>/g' \
      -e 's/\([0-9]\)e+*\(-*\)0*\([1-9][0-9]*\)/\1·10<sup>\2\3<\/sup>/g; s/<sup>-/<sup>−/g'
}

cat <<'HTML'
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>A cylinder and a shell roll to rest on a soft mat</title>
<style>
body { max-width: 46rem; margin: 0 auto; padding: 1rem; font: 1.05rem/1.5 system-ui, sans-serif;
  color: #1a1a1a; background: #fff; }
h1, h2 { line-height: 1.2; }
h2 { margin-top: 2.5rem; border-top: 1px solid #bbb; padding-top: 1rem; }
a { color: #005a9c; }
figure { margin: 2rem 0; }
figure svg { display: block; width: 100%; height: auto; background: #fff; border-radius: 4px; }
.formula { margin: 1rem 0; padding-left: 1.2rem; }
.formula span { margin-left: 1.5em; }
.together { white-space: nowrap; }
figcaption { margin-top: .5rem; font-size: .95rem; color: #333; }
pre { font-size: .8rem; line-height: 1.35; }
code { font-size: .85em; background: #f3f1ec; padding: .1em .3em; overflow-wrap: anywhere; }
figcaption code { display: inline-block; color: #555; }
/* A shadow at an edge shows that there is more. */
.wide { overflow-x: auto; --page: #fff; --edge: rgba(0, 0, 0, .35);
  background:
    linear-gradient(to right, var(--page) 40%, transparent) 0 0 / 2rem 100%,
    linear-gradient(to left, var(--page) 40%, transparent) 100% 0 / 2rem 100%,
    linear-gradient(to right, var(--edge), transparent) 0 0 / .6rem 100%,
    linear-gradient(to left, var(--edge), transparent) 100% 0 / .6rem 100%;
  background-repeat: no-repeat; background-attachment: local, local, scroll, scroll; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0;
  font-size: .95rem; }
tr { border-bottom: 1px solid #ddd; }
th, td { padding: .25rem .8rem .25rem 0; text-align: left; vertical-align: top; }
th { white-space: nowrap; }
/* On a phone a figure is moved sideways, like a wide table, rather than made smaller than can be
   read: letters of 14 px keep 10 of them. A tap opens it alone. */
figure > a { display: block; overflow-x: auto; }
figure:target { position: fixed; inset: 0; margin: 0; padding: .5rem; overflow: auto;
  background: #fff; z-index: 1; }
figure:target svg { width: auto; min-width: 44rem; }
.back { display: none; }
figure:target .back { display: inline-block; padding: .5rem 0; }
@media (max-width: 36rem) { body { font-size: 1rem; padding: .7rem; }
  figure svg { width: max(100%, calc(.7 * var(--width))); }
  figure > a { border-inline: 2px dashed #999; }
  th, td { padding-right: .5rem; font-size: .85rem; } }
@media (prefers-color-scheme: dark) {
  body, figure:target { color: #e6e3dd; background: #16181b; }
  figcaption, figcaption code { color: #c9c5bc; }
  a { color: #7cb8ef; }
  code { background: #23262b; }
  .wide { --page: #16181b; --edge: rgba(255, 255, 255, .45); }
  h2, tr { border-color: #44484f; }
  figure svg { background: #f4f1ea; } }
@media print {
  body { max-width: none; font-size: 9.5pt; padding: 0; color: #000; background: #fff; }
  table, figcaption { font-size: 8.5pt; }
  table { margin: .5rem 0; }
  th, td { padding-top: .1rem; padding-bottom: .1rem; }
  figure, table, .section { break-inside: avoid; }
  figure { margin: .7rem 0; }
  figure svg { width: auto; max-width: 100%; height: auto; max-height: 8cm; margin: 0 auto; }
  h2, h3 { break-after: avoid; }
  h2 { margin-top: .8rem; padding-top: .6rem; }
  p { orphans: 3; widows: 3; } }
</style>
</head>
<body>
<h1>A cylinder and a shell roll to rest on a soft mat</h1>
<p>A rigid body on a rigid floor would roll for ever. On a mat it does not: the mat bulges in front
of the body and pushes back at a point P, a distance <i>D</i> ahead of the lowest point. The law of
the mat says how <i>D</i> depends on the velocity; it also determines where the energy goes. After Corridoni, D’Anna and Fuchs, <cite>Experiments and Models in Rolling Motion: Momentum, Angular
Momentum, Energy, and Dissipation</cite>; the numbers of the equations are theirs.
<code>samples/paper.sh</code> prints each of them with its command and what comes out.</p>
<p>Four experiments: a solid cylinder C and a cylindrical shell S, on felt and on a rubber mat,
followed by a sonar. <b>The runs here are not the authors’ measurements:</b>
<code>simulate</code> made them from the paper’s values, with the noise, the rounding and the lost
echoes of such a sensor. So the answer is known, and you can see how well the fits find it.</p>

<h2>The motion</h2>
HTML
drawn fig1 "Fig. 1: velocity against time" <<'HTML'
The hand pushes, lets go, and the body rolls freely. Grey: differences of the sonar’s positions;
coloured: the mean over eleven of them, 0.44 s; black: the motion that the law <i>D = a v<sup>b</sup></i>
predicts, fitted to the positions. <i>To discuss:</i> on felt the lines are nearly straight, on
rubber they are not; what does that say about the force? Why does the shell roll further than the
cylinder of equal mass and radius?
HTML
drawn fig1-stop "Fig. 1, the stop: a brief roll backwards" <<'HTML'
The cylinder on rubber near its stop. The paper reports that the bodies roll backwards for
a moment before they rest. A shift that depends on the velocity alone cannot do that: it vanishes
with the velocity. If the shift needs half a millimetre of rolling to build up and to vanish, the body
rolls back: at <i>v</i> = 0 the bulge is still there and pushes. This is not in the paper. The sonar
has steps of a millimetre and only just sees it; below the picture is the result of
<code>samples/roll-back.sh</code>.
HTML
cat <<'HTML'
<h2>The forces, and the point where they act</h2>
<p>The mat’s force has a normal part <i>F</i><sub>N</sub> = <i>m g</i> and a horizontal part
<i>F</i><sub>H</sub>. The horizontal part brakes the translation, but its torque would spin the body
up; only because <i>F</i><sub>N</sub> acts ahead of the axis do both slow down together. With the
arm factor <span class="together"><i>A</i> = √(1 − <i>D</i>²/<i>R</i>²)</span> and the moment of
inertia <i>K m R</i>²,</p>
<p class="formula"><i>F</i><sub>H</sub> = −<i>D F</i><sub>N</sub> / ((<i>K</i> + <i>A</i>)
<i>R</i>) <span>(9)</span><br/>
τ<sub>H</sub> = −<i>A R F</i><sub>H</sub> <span>(6)</span><br/>
τ<sub>N</sub> = −<i>D F</i><sub>N</sub> <span>(7)</span></p>
HTML
drawn fig2 "Fig. 2: the forces, to scale" <<'HTML'
All lengths are in proportion, and so are all forces except the two whose arrows have a break. The shift
is so small beside the radius that only the enlarged panels show it; the horizontal force, too, is small
beside the weight. <i>F</i><sub>N</sub> and <i>F</i><sub>H</sub> together are the force
<i>F</i><sub>S</sub> of the mat. It is closer to the vertical than the line from P to the axis, so it
passes ahead of the axis: one force slows the translation and the rotation. The torque of
<i>F</i><sub>H</sub> cancels a part of that of <i>F</i><sub>N</sub>; the rest slows the rotation. (The
outline of the mat is only sketched.) <i>To discuss:</i> where would P have to be if the body sped up?
HTML
drawn fig3 "Fig. 3: the velocity of P, to scale" <<'HTML'
P lies <i>A R</i> below the axis. As a point of the rolling body it turns about the lowest point. It
moves down into the mat with (<i>D</i>/<i>R</i>) <i>v</i>, Eq. 20, and forward with only
(1 − <i>A</i>) <i>v</i>, Eq. 16. The first is small of first order, the second of second order, so each
has its own panel. <i>To discuss:</i> which of the two carries the energy into the mat?
HTML
cat <<'HTML'
<h2>The law of the mat</h2>
HTML
drawn fig4 "Fig. 4: the shift against the velocity" <<'HTML'
Each point is <i>D</i> = −(1 + <i>K</i>) <i>R</i> d<i>v</i>/d<i>t</i> / <i>g</i>, Eq. 11, from the
smoothed velocities; lines are the power laws fitted to them, bands the 95 % confidence of each
line. On felt <i>D</i> is small and hardly depends on the velocity, and the lines of the two bodies
lie on each other; on rubber it grows with the velocity. The points of one body are not independent:
each reading is in eleven means, and the fit allows for that.
HTML
drawn residuals "The residuals of a fit" <<'HTML'
The cylinder on rubber: the residuals, measured positions minus those that the law predicts, against
time and against velocity. They scatter evenly about zero and not more in one place than
in another: the law describes the run. <i>To discuss:</i> what would they look like if the hand were
still on the body at the beginning, or the mat had a hole?
HTML
cat <<'HTML'
<div class="section"><h3>Table 1: <i>D</i> = <i>a v<sup>b</sup></i></h3>
<p>There are three routes: the points of Fig. 4; the motion of Fig. 1 fitted to the velocities of the
sensor, as the authors did; and the motion fitted to its positions, the most precise route. <i>a</i> is the
shift at 1 m/s. The first uncertainty comes from the noise, the second from <i>K</i> and <i>R</i>; more
rolls of the same body do not make the second smaller. The runs were simulated with the paper’s values. The
columns “off” have the differences from these values, in standard uncertainties of the noise.
<code>make table1</code></p>
HTML
table "Table 1" "$scratch/table1"
echo '</div><div class="section"><h3>What the paper expects</h3>'
table "What the paper" "$scratch/table1"
cat <<'HTML'
</div><div class="section"><h3>Is the mat level?</h3>
<p>No floor is level to a millimetre in a metre, and on felt that is 7 % of the shift. A roll in one
direction hides it: the residuals of its fit are as good as on a level mat. Two rolls in opposite
directions separate the slope from the law. <i>To discuss:</i> the paper’s bodies all rolled towards the
sensor. What does a slope do to the difference of their laws?</p>
HTML
table "A mat that is not level" "$scratch/table1"
echo '</div>'
cat <<'HTML'
<h2>Where the energy goes</h2>
HTML
drawn energy "Energy against time" <<'HTML'
The cylinder on rubber. Points: the stored energy comes from the measured velocities alone, the
dissipated energy from the fitted shift, that is, from the forces. Lines are the same for the fitted
motion. Their sum is constant only if the shift is right. At any speed the rotation of the cylinder has
half the energy of its translation: that is its <i>K</i>.
HTML
drawn turn "Up an incline, and back" <<'HTML'
A ball rolls up 2 cm a metre, turns and comes back. Rolling resistance opposes the motion both
ways; gravity does not: one such run separates the slope from the law. The ball comes back slower than it
went; the missing energy has been dissipated. <i>To discuss:</i> why is the line of the velocity steeper on the way
up?
HTML
cat <<'HTML'
<div class="section"><h3>The check</h3>
<p>The measured loss of each run stands beside the energy that the shift of Table 1 dissipates. The closure is
their relative difference (Eq. 23). Its uncertainty comes from the measured speeds at both ends: it is the
scatter of a hundred rolls under the law with the noise of the run. The imbalance is the largest difference
of the two at any moment of the run.</p>
HTML
table "Energy" "$scratch/table1"
cat <<'HTML'
</div><div class="section">
<p>The balance of one body cannot show that <i>K</i> is wrong: it cancels. The law of the other body on
the same mat can. On felt it closes; on rubber it is off by 8 and 12 %, as the paper’s own
values for the two bodies are.</p>
HTML
table "The same with" "$scratch/table1"
echo '</div>'
drawn fig5 "Fig. 5: the process diagram" <<'HTML'
Horizontal momentum flows from the body to the mat and falls from the speed <i>v</i> of the axis to
that of P. The power it releases, <i>P</i><sub>T1</sub>, pumps angular momentum into the body,
<i>P</i><sub>R1</sub>. Angular momentum leaves again, falls from ω to nothing and releases
<i>P</i><sub>R2</sub>, which pumps vertical momentum from P, moving down, to the body at rest in
height, <i>P</i><sub>T2</sub>; gravity removes it there. With these two momenta the energy currents
<i>I</i><sub>E1</sub> and <i>I</i><sub>E2</sub> reach the mat, where they fall to nothing and release
<i>P</i><sub>T3</sub> and <i>P</i><sub>T4</sub>: everything is dissipated. The numbers at the top are the
stored quantities and the currents of the momenta. The width of an arrow is its power, from
<code>energy-ledger</code>; flows out of the body and released powers are positive. <i>To discuss:</i> nearly all of the energy goes through the rotation, although two thirds
of it are translational. How?
HTML
echo '<h2>How exact, in what time</h2>'
if [ -n "$measured" ]; then
  cat <<'HTML'
<p>The error of the velocity against the time for a sample, for every method and several
tolerances: lower left is better. Points at 10<sup>−17</sup> do not differ from the
reference. Filled: the methods of <code>simulate</code>, which locate the stop. Open and dashed: the
solvers of GSL, and of CVODE if it is installed, used in the ordinary way, if they reached the end; “odd”
has a law that continues to negative velocities. The times are of one machine: the ratios count.</p>
HTML
  while read -r name title; do
    [ -r "$measured/$name.svg" ] || continue
    figure "$measured/$name.svg" "$title" "make work-precision" <<<""
  done <<'LIST'
CR The cylinder on rubber, with A = 1
exact-CR The cylinder on rubber, with A of Eq. 8
slope The cylinder on felt, up a slope of 5 mm/m to the stop
turn The cylinder on felt, up a slope of 20 mm/m and back
bowl A ball in a bowl of 1 m, which turns several times: one method, by its tolerance
hills A car that coasts over hills of 2 m, likewise
memory-1e-4 The cylinder on rubber, with a memory of 0.1 mm
memory-1e-7 The cylinder on rubber, with a memory of 0.1 µm, which is stiff
LIST
else
  cat <<'HTML'
<p>The methods of <code>simulate</code> on the cylinder on rubber: the largest error of the velocity
beside the closed form, the error of the time of the stop, and the time for a sample. The times are of
one machine: the ratios count. <code>simulate --scene samples/CR.toml --report</code>. All
methods on many problems, as figures: <code>make work-precision</code>, some minutes, and then
<code>make report</code>.</p>
HTML
  # The rows as table1.sh sets its own.
  { echo methods; simulate --scene CR.toml --report --digits 2; } |
    awk -F '\t' 'NR == 1 { print; next }
      { sub(/^# /, ""); if ($2 == "") $2 = "-"
        print "  " $1 "  " $2 "  " $3 "  " $4 "  " $5 "  " $6 }' >"$scratch/methods"
  table methods "$scratch/methods"
fi
# raw FILE: as it is
raw() { echo "<div class=\"wide\"><pre>$(sed 's/&/\&amp;/g; s/</\&lt;/g' "$1")</pre></div>"; }
if [ -r tools.txt ]; then
  echo '<p>The processor time of each tool for ten rows, and the libraries that it needs besides those of C++:
nothing is linked that is not called. <code>make work-precision</code></p>'
  raw tools.txt
fi
cat <<'HTML'
<h2>How often the intervals hold</h2>
<p>Uncertainties are right if intervals of ±1.96 of them hold the truth in 95 of 100 runs. Simulated runs
show this, since their truth is known. <code>make coverage</code></p>
HTML
raw coverage.txt
cat <<HTML
<h2>How this page was made</h2>
<p><code>make report</code> ran $(simulate --version |
  sed 's/^simulate (\([a-z]*\)) /\1 /'): six small tools,
<code>smooth</code>, <code>differentiate</code>, <code>shift-from-accel</code>,
<code>fitpower</code>, <code>simulate</code> and <code>energy-ledger</code>, which read and write
plain columns and are joined by pipes. The pipeline of each figure is the script
of its name in <code>samples/figures</code>.$([ ! -e "$figures/man/index.html" ] ||
  echo ' The <a href="man/index.html">manual pages</a> explain each tool and all options.')</p>
</body>
</html>
HTML
