#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The figures say what the tools say: each script draws, in silence, a well-formed picture; the
# arrows of Fig. 5 are as wide as the powers of energy-ledger and labelled with them; the bands of
# Fig. 4 lie about their laws by 1.96 standard errors; Figs. 2 and 3 have the forces and velocities
# of the equations, to scale; the sum in energy stays; the report has them all in it; and make
# builds for a figure no more than it needs.
set -eu
export LC_ALL=C
unset CDPATH
command -v gnuplot >/dev/null ||
  { echo "skipped: no gnuplot; make setup check installs it"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*"; wrong=1; }

parser() { python3 -c 'import xml.dom.minidom' 2>/dev/null; }  # whether there is one for what is well-formed

# draw NAME [INSTANT]: the picture, and its texts, a line each.
draw() {
  "samples/figures/$1.sh" "${@:2}" >"$scratch/$1.svg" 2>"$scratch/said" || complain "$1: exit $?"
  [ ! -s "$scratch/said" ] || { complain "$1 says:"; cat "$scratch/said"; }
  tr -d '\n\t' <"$scratch/$1.svg" | sed 's|<title>[^<]*</title>||g; s|</text>|\n|g' |
    sed 's/<[^>]*>//g; s/^ *//; s/ *$//; s/−/-/g' >"$scratch/$1.text"
}
has() {  # NAME TEXT...
  local name=$1 text
  for text in "${@:2}"; do grep -qxF -e "$text" "$scratch/$name.text" ||
    complain "$name: no '$text'"; done
}

for script in samples/figures/*.sh; do
  name=$(basename "$script" .sh)
  [ "$name" != draw ] || continue
  draw "$name"
  grep -q '^</svg>' "$scratch/$name.svg" || complain "$name: no end"
  sed '/<g /,$d' "$scratch/$name.svg" | grep -q '<title>[^<]' &&
    ! grep -qi '<title>gnuplot' "$scratch/$name.svg" || complain "$name: no title of its own"
  if parser; then
    python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$scratch/$name.svg" ||
      complain "$name: not well-formed"
  fi
done
samples/figures/fig2.sh -t png | head -c 8 | cmp -s - <(printf '\211PNG\r\n\032\n') || complain 'fig2: no PNG'
samples/figures/fig4.sh -t pdf | head -c 5 | cmp -s - <(printf %%PDF-) || complain 'fig4: no PDF'
has fig1 'velocity v / (m/s)' 'time t / s' 'C on rubber' 'S on rubber' 'C on felt' 'S on felt' 'fitted trajectory' \
  'before smoothing'
# Each of the four runs is inside its panel, that towards falling x too.
awk '/id="gnuplot_plot_[34][ab]"/ { run = $0 } !/id="gnuplot_plot_[34][ab]"/ && /id="gnuplot_plot_/ { run = "" }
  run && /<use/ { points[run]++ }
  END { for (run in points) if (points[run] > 15) runs++; exit runs != 4 }' "$scratch/fig1.svg" || complain 'fig1: not four runs'
has fig1-stop 'velocity v / (mm/s)' 'distance from rest / mm' \
  'with a memory of 0.5 mm (given, not fitted)'
has fig4 'velocity v / (m/s)' 'shift D / mm' 'C on rubber' 'S on rubber' 'C on felt' 'S on felt' \
  'Bands: 95 % confidence of the law, not of the points.' \
  'Points: the free roll, less half a window of 0.44 s at each end.'
kept=$(smooth -q --coast -c x samples/CR.csv | grep -c '^[^#]')
has residuals 'residual / mm' 'time t / s' 'velocity v / (m/s)' "rms 0.414 mm, scatter 0.441 mm;  $kept of 154 rows;  no outlier"
has turn 'energy / mJ' 'velocity v / (m/s)' 'time t / s' translational rotational dissipated lifted sum \
  measured fitted
has energy 'energy / J' 'time t / s' translational rotational dissipated sum \
  measured fitted

# Figs. 2 and 3 by the equations, from a, b, K, R, m of the scene and v = 0.5 m/s: the numbers that
# they say, and where the tips of their arrows are, by the lower left corner of each panel in pixels
# and in millimetres, and its scale.
awk 'function say(text, x) { printf "%s\n", sprintf(text, x) }
  function tip(figure, height, left, bottom, x0, y0, scale, x, y) {
    printf "%d tip %.3f %.3f\n", figure, left + (x - x0) * scale, height - bottom - (y - y0) * scale }
  BEGIN {
    K = 0.5; R = 0.04; W = 1.375 * 9.81; v = 0.5; D = 1.87e-3 * v^0.215; A = sqrt(1 - (D / R)^2);
    F = -D * W / ((K + A) * R)
    say("2 D = %.3g mm", 1e3 * D); say("2 FH = %.3g N", F); say("2 %.3g N", W);
    say("2 τN = -D FN = %.3g mN m", -1e3 * D * W)
    say("2 τH = -A R FH = +%.3g mN m", -1e3 * A * R * F);
    say("2 P is %.2g mm above the lowest point", 1e3 * R * (1 - A))
    say("2 %.2g° off", atan2(D / R, A) * 45 / atan2(1, 1))
    say("3 D = %.3g mm", 1e3 * D); say("3 = %.3g mm/s", -1e3 * v * D / R);
    say("3 v(P)H = (1 - A) v = %.3g mm/s", 1e3 * (1 - A) * v)
    say("3 = %.2g mm", 1e3 * R * (1 - A))
    say("2 p = %.3g N s", 1.375 * v); say("2 L = %.3g mN m s", 1e3 * K * 1.375 * R * v)
    say("2 τN + τH = %.3g mN m: ω falls", -1e3 * (D * W + A * R * F))
    say("2 %.2g° off", atan2(-F, W) * 45 / atan2(1, 1))
    say("2 FS = %.3g N,", sqrt(F^2 + W^2))
    say("2 the line of FS, %.3g mm ahead", 1e3 * D * K / (K + A))
    say("3 A R = %.4g mm", 1e3 * A * R)
    d = 1e3 * D; r = 1e3 * R; p = r * (1 - A); newton = 27 / W; speed = 50  # mm for 1 N, for 1 m/s
    tip(2, 640, 0, 60, -58, -42, 3.45, 0, r - newton * W);
    tip(2, 640, 0, 60, -58, -42, 3.45, d, p + newton * W)
    tip(2, 640, 415, 15, -0.43 * d, -0.62 * d, 200 / d, d + newton * F, p)
    long = 1.3 * d - p; tip(2, 640, 415, 15, -0.43 * d, -0.62 * d, 200 / d, d + long * F / W, p + long)
    tip(3, 780, 0, 290, -58, -42, 3.45, speed * v, r);
    tip(3, 780, 0, 290, -58, -42, 3.45, speed * 2 * v, 2 * r)
    tip(3, 780, 415, 325, -0.43 * d, -d, 200 / d, d, p - speed * v * D / R)
    tip(3, 780, 15, 15, d - 390 * p / 97, -0.7 * p, 97 / p, d + speed * v * (1 - A), p) }' >"$scratch/geometry"
for figure in 2 3; do  # the body: a black circle of 2 R in height and width
  tr -d '\n\t' <"$scratch/fig$figure.svg" | sed 's/</\n</g' |
    grep "^<path stroke='rgb(  0,   0,   0)'" | awk '
    { n = split($0, at, /[ ML]+/); left = right = ""
      for (i = 1; i <= n; i++) if (at[i] ~ /^[0-9.]+,[0-9.]+/) {
        split(at[i], xy, ","); if (left == "") { left = right = xy[1]; top = bottom = xy[2] }
        if (xy[1] < left) left = xy[1]; if (xy[1] > right) right = xy[1]
        if (xy[2] < top) top = xy[2]; if (xy[2] > bottom) bottom = xy[2] }
      if ((right - left - 80 * 3.45)^2 + (bottom - top - 80 * 3.45)^2 < 0.01) found = 1 }
    END { exit !found }' || complain "fig$figure: no circle"
done
while read -r figure text; do
  case $text in
    tip*) grep -oE "points = '[^']*" "$scratch/fig$figure.svg" | awk -v want="$text" '
            BEGIN { split(want, at, " ") }
            { split($5, head, ","); if ((head[1] - at[2])^2 < 0.01 && (head[2] - at[3])^2 < 0.01) found = 1 }
            END { exit !found }' || complain "fig$figure: no arrow ends at ${text#tip }" ;;
    p*) grep -qF "$text" "$scratch/fig$figure.text" || complain "fig$figure: no '$text'" ;;
    *) has "fig$figure" "$text" ;;
  esac
done <"$scratch/geometry"
[ "$(wc -l <"$scratch/geometry")" = 26 ] ||
  complain "the geometry has $(wc -l <"$scratch/geometry") lines"

# Fig. 5 at its own instant and at another: label after label, and the widths of the shafts in the
# order in which they are drawn.
for instant in 0.5 1.5; do
  draw fig5 "$instant"
  printf 't\n%s\n' "$instant" | simulate --scene samples/CR.toml --exact --at - |
    energy-ledger --scene samples/CR.toml --exact --columns \
      E,p,L,I_E1,I_E2,P_T1,P_R1,P_R2,P_T2,P_T3,P_T4,P_diss,I_pH,I_pN,I_LH,I_LN,F_G | sed '/^# /s/\[[^]]*\]//g' >"$scratch/row"
  grep -oE "fill = 'rgb\(245, 208, 160\)' points = '[^']*" "$scratch/fig5.svg" |
    sed "s/.*'//" >"$scratch/shafts"
  awk -v instant="$instant" '
    function off(x, y) { return (x / y - 1)^2 > 0.006^2 }  # three figures; a hundredth of a pixel
    function compare(what, x, y) {
      checks++
      if (off(x, y)) {
        print "fig5 at " instant ": " what " is " x ", energy-ledger says " y; bad = 1 } }
    FILENAME ~ /row$/ && /^# / {
      sub(/^# /, ""); for (i = 1; i <= NF; i++) name[i] = $i
      next }
    FILENAME ~ /row$/ && !/^#/ {
      for (i = 1; i <= NF; i++) is[name[i]] = $i
      is["trans"] = -1.375 * is["v"] * is["a"]; is["rot"] = is["trans"] / 2; next }
    FILENAME ~ /text$/ {
      if (before ~ /^(P[TR][12]|IE2)$/) { key = before; sub(/E/, "_E", key); sub(/^P/, "P_", key)
        compare(before, $1 / 1e3, is[key]) }
      if (before ~ /^(P[TR][12]|IE2)$/) said[before] = $1
      if (before == "Pdiss = PT3 + PT4") {
        compare("P_diss", $2 / 1e3, is["P_diss"]); said["diss"] = $2 }
      if (/^IE1 = /) compare("I_E1", 100 * $3, int(1e5 * is["I_E1"] + 0.5))  # mW, two decimals
      if (/^PT3 = /) compare("P_T3", 100 * $3, int(1e5 * is["P_T3"] + 0.5))
      if (/^PT4 = /) compare("P_T4", $3 / 1e3, is["P_T4"])
      if (/^I[pL][HN] = /) compare($1, $3 * ($4 == "mN" ? 1e-3 : 1), is["I_" substr($1, 2)])
      if (/^FG = /) compare("F_G", $3, is["F_G"])
      if (/^px = /) compare("p_x", $3, is["p"])
      if (/^L = /) compare("L", $3 / 1e3, is["L"])
      if (/^E = /) compare("E", $7 * ($8 == "mJ" ? 1e-3 : 1), is["E"])
      if (/^py = 0/) stored = 1
      if (stored && /^[0-9.]+$/ && !("trans" in said)) { said["trans"] = $1; compare("what E_trans gives", $1 / 1e3, is["trans"]) }
      else if (stored && /^[0-9.]+$/ && !("rot" in said)) said["rot"] = $1
      if (/^ΠS = /) compare("Pi_S", $5 / 1e3, is["P_diss"] / 293)
      before = $0; next }
    { split($1, first, ","); split($7, last, ",");
      width[FNR] = sqrt((first[1] - last[1])^2 + (first[2] - last[2])^2) }
    END {
      split("P_T1 P_R2 I_E2 trans rot P_diss", drawn, " ")
      for (i = 1; i <= 5; i++) compare("the width of " drawn[i], width[i] / width[6], is[drawn[i]] / is["P_diss"])
      if ((said["trans"] + said["rot"] - said["diss"])^2 > 1e-9 ||
          (said["PT1"] + said["rot"] - said["PR2"])^2 > 1e-9) {
        print "fig5: its numbers do not add up:", said["trans"], said["rot"], said["PR2"], said["diss"]
        bad = 1 }
      if (checks != 24) { print "fig5: " checks " of 24 numbers found"; bad = 1 }
      exit bad }' "$scratch/row" "$scratch/fig5.text" "$scratch/shafts" || wrong=1
done

# Fig. 4: at 0.1 and 0.5 m/s each law and its band, read off the picture, where fitpower puts them.
part() { awk -v n="$2" '/id="gnuplot_plot_/ { on = index($0, "\"gnuplot_plot_" n "\"") } on' "$scratch/$1.svg"; }
curve() { part fig4 "$1" | grep -oE "[ML' ][0-9.]+,[0-9.]+" | tr -d "ML' " | tr ',' ' '; }
axes() { grep -oE "d='M[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+" "$scratch/$1.svg" |
  tail -n 1 | tr -c '0-9.\n' ' '; }
frame=$(axes fig4)
i=0
for run in CR:0.5 SR:0.83 CF:0.5 SF:0.83; do
  i=$((i + 1))
  smooth -q --coast -c x -w 1 "samples/${run%:*}.csv" | differentiate -c x | smooth --seconds 0.44 |
    differentiate |
    shift-from-accel -K "${run#*:}" -R 0.04 | fitpower -q | tail -n 1 >"$scratch/law"
  curve $i >"$scratch/band"
  { curve $((i + 8)); curve $((i + 12)); } >"$scratch/line"
  awk -v frame="$frame" -v run="$run" '
    # The frame: left top left bottom right bottom, for D from 2.2 mm to 0, v from 0 to 0.5 m/s.
    BEGIN { split(frame, f, " ") }
    function D(y) { return (f[4] - y) / (f[4] - f[2]) * 2.2e-3 }
    function at(v) { return f[1] + (f[5] - f[1]) * v / 0.5 }
    function near(x, v) { return (x - at(v))^2 < 2.6 }
    FILENAME ~ /law$/ { a = $1; sa = $2; b = $3; sb = $4; corr = $5; next }
    FILENAME ~ /band$/ {
      for (v = 0.1; v <= 0.5; v += 0.4) if (near($1, v)) {
        if (!(v in low) || D($2) < low[v]) low[v] = D($2)
        if (D($2) > high[v]) high[v] = D($2) }
      next }
    { for (v = 0.1; v <= 0.5; v += 0.4) if (near($1, v)) law[v] = D($2) }
    END {
      for (v = 0.1; v <= 0.5; v += 0.4) {
        want = a * v^b; s = 1.96 * sqrt((sa / a)^2 + (sb * log(v))^2 + 2 * corr * sa / a * sb * log(v)); checks++
        below = want * exp(-s); above = want * exp(s); pixel = 2.2e-3 / (f[4] - f[2])
        if (!(low[v] < law[v] && law[v] < high[v])) {
          print run ": the law is not in its band at " v; bad = 1 }
        if ((law[v] - want)^2 > pixel^2 || (low[v] - below)^2 > pixel^2 || (high[v] - above)^2 > pixel^2) {
          print run " at " v ": drawn", low[v], law[v], high[v], "for", below, want, above;
          bad = 1 } }
      exit bad || checks != 2 }' "$scratch/law" "$scratch/band" "$scratch/line" ||
        complain "fig4: $run"
done

# The residuals, read off the picture at two of its ticks, are those of Eq. 13 with the row of
# fitpower; the rms is that of the row; a row that is 5.6 times the scatter off is named, one that is
# 4.5 times off is not.
smooth -q --coast -c x -w 1 samples/CR.csv >"$scratch/CR.roll"
fitpower -q --route position -K 0.5 -R 0.04 "$scratch/CR.roll" >"$scratch/fit"
part residuals 1a | grep -oE "gpPt6' transform='translate\([0-9.]+,[0-9.]+" | sed 's/.*(//; s/,/ /' >"$scratch/drawn"
tr -d '\n\t' <"$scratch/residuals.svg" | sed 's|</text>|\n|g' |
  sed -nE "s/.* d='M[0-9.]+,([0-9.]+) L[0-9., ]*'.*text-anchor=\"end\">/\1 /; s/<[^>]*>//g; s/−/-/g; /^[0-9.]+ *-?1$/p" >"$scratch/ticks"
awk '
  FILENAME ~ /fit$/ { if (!/^#/) { a = $1; b = $3; rms = $6; v0 = $8 } next }
  FILENAME ~ /roll$/ { if (!/^#/) { if (!n++) start = $1; t[n] = $1; x[n] = $2 } next }
  FILENAME ~ /ticks$/ { if ($2 == 1 && !high) high = $1; if ($2 == -1 && !low) low = $1; next }
  { y[++drawn] = $2 }
  END {
    c = 9.81 / (1.5 * 0.04)
    for (i = 1; i <= n; i++) {
      left = v0^(1 - b) - (1 - b) * a * c * (t[i] - start); v = left > 0 ? left^(1 / (1 - b)) : 0
      r[i] = x[i] - (v0^(2 - b) - v^(2 - b)) / ((2 - b) * a * c); sum += r[i] }
    for (i = 1; i <= n; i++) {
      is = (low - y[i]) / (low - high) * 2 - 1
      if ((is - 1e3 * (r[i] - sum / n))^2 > (2 / (low - high))^2) { print "residual at " t[i] ": " is; bad = 1 } }
    if (drawn != n || n < 40 || !(low > high + 50)) { print drawn " residuals for " n, low, high; bad = 1 }
    exit bad }' "$scratch/fit" "$scratch/CR.roll" "$scratch/ticks" "$scratch/drawn" || complain 'residuals'
grep -q "rms $(awk '!/^#/ { printf "%.3g", 1e3 * $6 }' "$scratch/fit") mm, scatter" "$scratch/residuals.svg" ||
  complain 'residuals: another rms'
awk -F, -v OFS=, 'NR == 62 { $2 -= 0.0024 } NR == 70 { $2 += 0.0018 } { print $1, $2 }' samples/CR.csv >"$scratch/off.csv"
samples/figures/residuals.sh -K 0.5 -R 0.04 "$scratch/off.csv" >"$scratch/off.svg" 2>&1 || complain 'residuals of a row that is off'
grep -q "t = 2.72 s" "$scratch/off.svg" && grep -q "1 outlier" "$scratch/off.svg" || complain 'residuals: the outlier is not named'

# The stop: in the upper panel, from -22 to 110 mm/s, the law alone ends at 0, and with memory the
# lowest velocity is simulate's.
smooth -q --coast -c x -w 1 samples/CR.csv |
  fitpower -q --route position -K 0.5 -R 0.04 >"$scratch/fit"
back=$(simulate --law "$scratch/fit" -K 0.5 -R 0.04 --until 5.6 --dt 0.005 --columns v --memory 5e-4 --damping 0.02 |
  awk '!/^#/ && $1 < least { least = $1 } END { print least }')
read -r _ top _ bottom _ < <(grep -oE "d='M[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+" "$scratch/fig1-stop.svg" |
  head -n 1 | tr -c '0-9.\n' ' ')
lowest() {  # the lowest point of a curve that is above the axis
  part fig1-stop "$1" | grep -oE '[ML][0-9.]+,[0-9.]+' |
    awk -F, -v bottom="$bottom" '$2 < bottom - 1 && $2 > y { y = $2 } END { print y }'
}
awk -v law="$(lowest 3a)" -v memory="$(lowest 2a)" -v back="$back" -v top="$top" -v bottom="$bottom" '
  function v(y) { return (bottom - y) / (bottom - top) * 0.132 - 0.022 }
  BEGIN {
    pixel = 0.132 / (bottom - top)
    if (!(back < -2e-3 && v(law)^2 < pixel^2 && (v(memory) - back)^2 < pixel^2)) {
      print "fig1-stop: lowest", v(law), v(memory), "instead of 0 and", back; exit 1 } }' || wrong=1

# energy: the line of the sum is level within a pixel in 500, its points within 3 %; what is
# dissipated ends there.
heights() { part energy "$2" | grep -oE "$3[0-9.]+,[0-9.]+" | sed "s/.*,/$1 /"; }
read -r _ _ _ bottom _ < <(axes energy)
{ heights line 4 '[ML]'; heights point 8 'translate.'; heights dissipated 3 '[ML]'; } |
  awk -v bottom="$bottom" '
  { y = bottom - $2; n[$1]++; last[$1] = y; if (!($1 in low) || y < low[$1]) low[$1] = y;
    if (y > high[$1]) high[$1] = y }
  END {
    sum = low["line"]
    if (n["line"] < 50 || n["point"] < 15 || high["line"] - sum > 1 || low["point"] < 0.97 * sum || high["point"] > 1.03 * sum ||
        low["dissipated"] > 1 || (last["dissipated"] - sum)^2 > 1) {
      print "energy: sum", sum, high["line"], "points", low["point"], high["point"], "dissipated", last["dissipated"]; bad = 1 }
    exit bad }' || wrong=1

# The report: one well-formed page that loads nothing, each name in it once, the figures, and every
# number of table1.sh.
samples/report.sh "$scratch" >"$scratch/report.html" 2>"$scratch/said" || complain "report: exit $?"
[ ! -s "$scratch/said" ] || { complain "report says:"; cat "$scratch/said"; }
if parser; then
  python3 - "$scratch/report.html" <<'PYTHON' || complain "report: not as it should be"
import collections, sys, xml.dom.minidom
page = xml.dom.minidom.parse(sys.argv[1])
elements = page.getElementsByTagName("*")
names = collections.Counter(e.getAttribute("id") for e in elements if e.hasAttribute("id"))
wrong = [f"{n} times id {i}" for i, n in names.items() if n > 1]
for e in elements:
    for attribute in ("src", "href", "xlink:href", "data"):
        to = e.getAttribute(attribute)
        if to and to != "#_" and not (to.startswith("#") and to[1:] in names):
            wrong.append(f"{e.tagName} refers to {to}")
wrong += [f"no svg in {f}" for f in ("fig1", "fig1-stop", "fig2", "fig3", "fig4", "fig5", "energy", "turn", "residuals")
          if not any(e.getElementsByTagName("svg") for e in elements if e.getAttribute("id") == f and e.tagName == "figure")]
print(*wrong, sep="\n")
sys.exit(bool(wrong))
PYTHON
fi
sed 's/<[^>]*>/ /g; s/−/-/g' "$scratch/report.html" | grep -oE '[-+]?[0-9]+[.][0-9]+' |
  sort -u >"$scratch/in-page"
samples/table1.sh | grep '^  ' | grep -oE '[-+]?[0-9]+[.][0-9]+' | sort -u >"$scratch/in-table"
[ "$(wc -l <"$scratch/in-table")" -gt 40 ] || complain "report: table1.sh prints too little"
missing=$(comm -23 "$scratch/in-table" "$scratch/in-page")
[ -z "$missing" ] || complain "report: not in the page:" $missing

# The README shows Fig. 4 and the picture of its first example as this gnuplot, if it is the same
# one, draws them today.
drawn='samples/figures/fig4.sh -K 0.5 -R 0.04 samples/CR.csv'
grep -qF "\`$drawn >run.svg\`" README.md || complain 'README: no run.svg'
$drawn 2>/dev/null >"$scratch/run.svg"
for picture in fig4 run; do
  drawn_by=$(grep -o 'GNUPLOT [0-9.]*' "samples/$picture.svg")
  [ "$drawn_by" = "GNUPLOT $(gnuplot --version | cut -d ' ' -f 2)" ] || continue
  diff <(grep -v '<desc>' "samples/$picture.svg") <(grep -v '<desc>' "$scratch/$picture.svg") >/dev/null ||
    complain "samples/$picture.svg is not what samples/figures/fig4.sh draws: see $0"
done

# Where labels stand: "too long" beside the tip of the arrow that is too long (x = 415 + 1.43 * 200), and
# the name of the energy axis at the middle of its frame.
place() {  # NAME WORDS: x and y of that label
  tr -d '\n\t' <"$scratch/$1.svg" | sed 's/<g /\n<g /g' | grep -F -e "$2" | grep -oE 'translate\([0-9.]+,[0-9.]+' |
    head -n 1 | tr -c '0-9.\n' ' '
}
draw fig2
draw turn
place fig2 'too long' | awk '{ exit !($1 > 701 && $1 < 741) }' || complain "fig2: 'too long' is not beside its arrow"
place turn 'energy / mJ' | awk -v frame="$(axes turn)" '{ split(frame, at, " "); exit !(($2 - (at[2] + at[4]) / 2) ^ 2 < 4) }' ||
  complain 'turn: the name of the energy axis is not at its middle'

exit $wrong
