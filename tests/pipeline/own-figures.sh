#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The figures of runs of somebody's own: each draws that run, as the tools see it, passes on what they
# say, and refuses in one line what it cannot use. What all figures share is asked of some in turn, of
# each with LONG=1.
set -eu
export LC_ALL=C
unset CDPATH
command -v gnuplot >/dev/null ||
  { echo "skipped: no gnuplot; make setup check installs it"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*"; wrong=1; }
turn=0
in_turn() { turn=$((turn + 1)); [ $((turn % $1)) = 0 ] || [ -n "${LONG:-}" ]; }  # one of so many
for figure in ${LONG:+fig1 fig2 fig4 fig5} fig1-stop fig3 energy turn residuals; do
  samples/figures/$figure.sh >"$scratch/$figure.svg" || complain "$figure: $?"
done
part() { awk -v n="$2" '/id="gnuplot_plot_/ { on = index($0, "\"gnuplot_plot_" n "\"") } on' "$scratch/$1.svg"; }
axes() { grep -oE "d='M[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+ L[0-9.]+,[0-9.]+" "$scratch/$1.svg" |
  tail -n 1 | tr -c '0-9.\n' ' '; }

# A run of somebody's own that is the scene without noise: the pictures of one instant say what those of
# the scene say, towards either side; those of a whole roll are the sample's, if it is that run; a file
# of two runs is refused where there is one picture, and --run takes either.
texts() { tr -d '\n\t' <"$1" | sed 's|</text>|\n|g' | sed 's/<[^>]*>//g' | grep -v 'GNUPLOT\|^The cylinder\|^own'; }
body='-K 0.5 -R 0.04 -m 1.375'
simulate --scene samples/CR.toml --exact --dt 0.04 --columns t,x >"$scratch/own"
awk '/^#/ { print; next } { print $1 "\t" (-$2) }' "$scratch/own" >"$scratch/own-mirrored"
for figure in fig2 fig3 fig5; do
  for run in own own-mirrored; do
    for at in 0.1 0.5; do
      in_turn 5 || continue
      # shellcheck disable=SC2086  # words
      samples/figures/$figure.sh $body --at $at "$scratch/$run" >"$scratch/one.svg" 2>"$scratch/said" || complain "$figure of $run: $?"
      samples/figures/$figure.sh --at $at >"$scratch/scene.svg"
      diff <(texts "$scratch/one.svg") <(texts "$scratch/scene.svg") || complain "$figure of $run at $at is not that of the scene"
      grep -q 'smooth: --coast keeps' "$scratch/said" || complain "$figure does not pass on what smooth says"
    done
  done
done
simulate -K 0.4 -R 0.0127 -a 5e-5 -b 0.1 --slope 0.02 --v0 0.5 --sensor pasco --until 6.4 --seed 1 >"$scratch/ball"
for command in "energy $body samples/CR.csv" "turn -K 0.4 -R 0.0127 -m 0.067 $scratch/ball"; do
  # shellcheck disable=SC2086
  samples/figures/${command%% *}.sh ${command#* } 2>/dev/null | cmp - "$scratch/${command%% *}.svg" || complain "$command: another picture"
done
{ cat samples/CR.csv && echo ',,' && cat samples/SR.csv; } >"$scratch/two.csv"
for figure in ${LONG:+fig1-stop fig2 fig5 turn} fig3 energy; do
  # shellcheck disable=SC2086
  samples/figures/$figure.sh $body "$scratch/two.csv" >"$scratch/one.svg" 2>"$scratch/said" && complain "$figure of two runs"
  grep -q "^$figure.sh: this figure is of one run, not of 2: choose it with --run" "$scratch/said" && [ ! -s "$scratch/one.svg" ] ||
    complain "$figure of two runs: $(cat "$scratch/said")"
done
for figure in ${LONG:+fig1 fig2 fig4 fig5 fig1-stop energy} fig3 residuals; do
  # shellcheck disable=SC2086
  samples/figures/$figure.sh $body --law 'd0+d2*v^2' samples/CR.csv >"$scratch/law.svg" 2>"$scratch/said" || complain "$figure --law: $?"
  grep -q '^fitpower: run .*: ' "$scratch/said" || complain "$figure does not pass on what fitpower says"
  cmp -s "$scratch/law.svg" "$scratch/$figure.svg" && complain "$figure --law changes nothing"
done
names() { sed 's/two [12]/CR/; s/SR/CR/' "$1"; }
for figure in fig1 fig5 ${LONG:+fig1-stop fig2 fig3 fig4 energy residuals}; do
  # shellcheck disable=SC2086
  samples/figures/$figure.sh $body --run 2 "$scratch/two.csv" >"$scratch/one.svg" 2>/dev/null || complain "$figure --run 2: $?"
  # shellcheck disable=SC2086
  samples/figures/$figure.sh $body samples/SR.csv 2>/dev/null | names - | cmp - <(names "$scratch/one.svg") ||
    complain "$figure --run 2 is not that of its run"
  # What rolled is not guessed, and is nothing for the samples; a radius in millimetres is told.
  for wrong_one in '-K 0.5' '-R 0.04' '-m 1.375' '--run 1' '-c x' '--law d0'; do
    in_turn 2 || continue
    # shellcheck disable=SC2086
    said=$(samples/figures/$figure.sh $wrong_one 2>&1) && complain "$figure $wrong_one: the samples"
    [ "$said" = "$figure.sh: -${wrong_one#-}" ] || [ "$said" = "$figure.sh: ${wrong_one% *} is for a run of your own: name its FILE" ] ||
      complain "$figure $wrong_one: $said"
  done
  in_turn 2 || continue
  samples/figures/$figure.sh -K 0.5 -R 40 -m 1.375 samples/CR.csv 2>&1 >/dev/null | grep -q 'write 0.04 if that is millimetres' ||
    complain "$figure -R 40 is not told"
done
grep -q 'd0 = 1\.[0-9]* ± 0\.0[0-9]* mm,  d2 = ' "$scratch/law.svg" || complain 'residuals do not say another law'
# Velocities need no mass.
samples/figures/fig3.sh -K 0.5 -R 0.04 samples/CR.csv 2>/dev/null >"$scratch/one.svg" || complain 'fig3 needs a mass'
samples/figures/fig3.sh -K 0.5 -R 0.04 -m 1.375 samples/CR.csv 2>/dev/null | cmp - "$scratch/one.svg" || complain 'fig3 depends on the mass'
refused() {  # MESSAGE FIGURE OPERAND...: in one line, with status 2 and no picture
  local message=$1 status=0
  "samples/figures/$2.sh" "${@:3}" >"$scratch/one.svg" 2>"$scratch/said" || status=$?
  [ $status = 2 ] && [ ! -s "$scratch/one.svg" ] && [ "$(grep -v '^smooth:' "$scratch/said")" = "$2.sh: $message" ] ||
    complain "$*: status $status, $(cat "$scratch/said")"
}
refused 'abc is not a time in seconds; for a run of your own: -K 0.5 -R 0.04 -m 1.375' fig5 abc
refused 'at t = 99 s the body is at rest' fig5 99
refused '--slope is no option; fig2.sh --help lists them' fig2 --slope 0.1
refused 'say what rolled: -K 0.5 -R 0.04 -m 1.375' fig2 -K 0.5 -R 0.04 samples/CR.csv
refused 'say what rolled: -K 0.5 -R 0.04' fig1 samples/CR.csv
refused '-t pngx: svg, png or pdf' fig1 -t pngx
refused '--slope fit: a number, which fitpower --slope fit finds' fig4 -K 0.5 -R 0.04 --slope fit samples/CR.csv
refused '--slope 1,5: a number, which fitpower --slope fit finds' fig1 --slope 1,5
# What roll-back.sh says fits into the width, if no roll backwards is seen too.
simulate --scene samples/CR.toml --sensor pasco --seed 3 >"$scratch/still"
samples/figures/fig1-stop.sh -K 0.5 -R 0.04 "$scratch/still" 2>/dev/null >"$scratch/one.svg"
texts "$scratch/one.svg" | grep -q 'not seen above the noise' || complain 'fig1-stop: a roll backwards without a memory'
texts "$scratch/one.svg" | awk 'length > 75 { print "fig1-stop: too long: " $0; bad = 1 } END { exit bad }' || wrong=1
# Ten rows, or as few as smooth takes for a roll, are a picture or a line.
simulate --scene samples/CR.toml --dt 0.2 --columns t,x | awk '/^#/ { print; next } { printf "%s\t%.3f\n", $1, $2 }' >"$scratch/few"
for figure in ${LONG:+fig1 energy} fig4 residuals; do
  # shellcheck disable=SC2086
  samples/figures/$figure.sh $body "$scratch/few" >"$scratch/one.svg" 2>"$scratch/said" && ! grep -v '^smooth:' "$scratch/said" &&
    grep -q '^</svg>' "$scratch/one.svg" || complain "$figure of few rows: $(cat "$scratch/said")"
done
# What is left out is told, and nothing is if nothing was.
simulate --scene samples/CR.toml --until 2 --dt 0.04 --columns t,x >"$scratch/whole"
samples/figures/residuals.sh -K 0.5 -R 0.04 "$scratch/whole" 2>/dev/null >"$scratch/one.svg"
grep '>left<' "$scratch/one.svg" && complain 'residuals of all rows: some are left out'
grep -q '>left<' "$scratch/residuals.svg" || complain 'residuals of the sample: none is left out'
# Of eight runs four are dashed.
for run in 1 2 3 4 5 6 7 8; do cp samples/CR.csv "$scratch/run$run.csv"; done
samples/figures/fig4.sh -K 0.5 -R 0.04 "$scratch"/run?.csv 2>/dev/null >"$scratch/eight.svg"
for curve in 25 26 27 28 29 30 31 32; do part eight $curve | grep -m1 '<path' | grep -c dasharray || :; done | xargs >"$scratch/said"
[ "$(cat "$scratch/said")" = '0 0 0 0 1 1 1 1' ] || complain "fig4 of eight runs: dashes $(cat "$scratch/said")"
# The width of a window is one in seconds: a run with four times as many rows has the same points.
simulate --scene samples/CR.toml --dt 0.01 --columns t,x >"$scratch/own-fine"
simulate --scene samples/CR.toml --dt 0.04 --columns t,x >"$scratch/own-coarse"
for run in coarse fine; do
  samples/figures/fig4.sh -K 0.5 -R 0.04 "$scratch/own-$run" 2>/dev/null >"$scratch/one.svg" || complain "fig4 of own-$run"
  grep -c "href='#gpPt" "$scratch/one.svg"
done | xargs >"$scratch/said"
awk '{ exit !($2 / $1 > 3.5 && $2 / $1 < 4.3) }' "$scratch/said" || complain "fig4: points of 25 and of 100 rows a second: $(cat "$scratch/said")"

# Runs of somebody's own: a picture of speeds alone, in another unit and under a name that is no
# code, has the law of the route by D through the speeds as they are.
sed 's/Time (s),.*/Time (s),Velocity (km\/h)/; 2,$s/,.*,\(.*\)/,\1/' samples/CR.csv |
  awk -F, -v OFS=, 'NR > 1 && $2 != "" { $2 *= 3.6 }
    { print }' >"$scratch/my_'run'; set label.1.csv"
(cd "$scratch" && "$OLDPWD/samples/figures/fig4.sh" -K 0.5 -R 0.04 "my_'run'; set label.1.csv") \
  >"$scratch/own.svg" || complain "fig4 of an own run: exit $?"
# A roll towards falling x has the picture of its mirror image.
mkdir "$scratch/mirrored"
awk -F, -v OFS=, 'NR > 1 && $2 != "" { $2 = -$2 } { print $1, $2 }' samples/CR.csv \
  >"$scratch/mirrored/CR.csv"
cut -d , -f 1,2 samples/CR.csv >"$scratch/CR.csv"
for figure in fig1 fig4; do
  samples/figures/$figure.sh -K 0.5 -R 0.04 "$scratch/CR.csv" >"$scratch/towards-growing-x.svg"
  samples/figures/$figure.sh -K 0.5 -R 0.04 "$scratch/mirrored/CR.csv" |
    cmp - "$scratch/towards-growing-x.svg" || complain "$figure of a roll towards falling x"
done
mkdir "$scratch/swapped"
awk -F, -v OFS=, '{ print $2, $1 }' "$scratch/CR.csv" >"$scratch/swapped/CR.csv"
samples/figures/fig4.sh -K 0.5 -R 0.04 "$scratch/swapped/CR.csv" |
  cmp - "$scratch/towards-growing-x.svg" || complain "fig4 of a run with x before t"
smooth -q --coast -c v --seconds 0.44 "$scratch/my_'run'; set label.1.csv" | differentiate -c v |
  shift-from-accel -q -K 0.5 -R 0.04 | fitpower -q | tail -n 1 >"$scratch/law"
sed "s/&#39;/'/g" "$scratch/own.svg" | grep -qF "my_'ru…label.1:  a = " ||
    complain "own run: its name is not there"
# The picture says a, b, K and R with their uncertainties.
samples/figures/fig4.sh -K 0.50+-0.05 -R 0.04 "$scratch/CR.csv" >"$scratch/given.svg"
smooth -q --coast -c x -w 1 "$scratch/CR.csv" | differentiate -c x | smooth --seconds 0.44 | differentiate |
  shift-from-accel -K 0.50+-0.05 -R 0.04 | fitpower -q | awk -F'\t' '!/^#/ {
    printf "CR:  a = %.3f ± %.3f mm,  b = %.3f ± %.3f\n", 1e3 * $1, 1e3 * $2, $3, $4 }' >"$scratch/said"
grep -qF "$(cat "$scratch/said")" "$scratch/given.svg" || complain "fig4 does not say: $(cat "$scratch/said")"
grep -qF 'K = 0.50 ± 0.05, R = 0.04 m' "$scratch/given.svg" || complain 'fig4 does not say K and R'
# The bars are the scatter of the points that are drawn.
samples/figures/fig4.sh -K 0.5 -R 0.04 "$scratch/CR.csv" >"$scratch/bars.svg" 2>/dev/null
smooth -q --coast -c x -w 1 "$scratch/CR.csv" | differentiate -c x | smooth --seconds 0.44 | differentiate |
  shift-from-accel -K 0.5 -R 0.04 >"$scratch/shifts"
fitpower -q "$scratch/shifts" | awk -F'\t' '
  FNR == NR { if (!/^#/) { a = $1; b = $3 } next }
  !/^#/ { t[++n] = $1; v[n] = $3; D[n] = $5 }
  END {
    for (i = 1; i <= n; i++) if (t[i] - t[1] > 0.219 && t[n] - t[i] > 0.219) { sum += (1e3 * (D[i] - a * v[i]^b))^2; rows++ }
    printf "%.4f\n", sqrt(sum / rows) }' - "$scratch/shifts" >"$scratch/said"
grep -o 'Bars: scatter, ± [0-9.]*' "$scratch/bars.svg" | awk -v is="$(cat "$scratch/said")" '
  { exit !(($4 / is - 1)^2 < 1e-4) }' || complain "fig4: bars of $(grep -o 'Bars: [^<]*' "$scratch/bars.svg"), not $(cat "$scratch/said")"
# A slope, the column that is drawn, and columns by their place are those of the tools.
simulate --scene samples/CR.toml --slope 0.002 --sensor pasco --seed 3 | cut -d , -f 1,2 >"$scratch/CR.csv"
samples/figures/fig4.sh -K 0.5 -R 0.04 --slope 0.002 "$scratch/CR.csv" >"$scratch/sloped.svg" ||
  complain "fig4 --slope: exit $?"
smooth -q --coast -c x -w 1 "$scratch/CR.csv" | differentiate -c x | smooth --seconds 0.44 | differentiate |
  shift-from-accel -q -K 0.5 -R 0.04 --slope 0.002 | fitpower -q | awk -F'\t' '!/^#/ {
    printf "CR:  a = %.3f ± %.3f mm,  b = %.3f ± %.3f\n", 1e3 * $1, 1e3 * $2, $3, $4 }' >"$scratch/said"
grep -qF "$(cat "$scratch/said")" "$scratch/sloped.svg" || complain "fig4 --slope does not say: $(cat "$scratch/said")"
grep -qF 'slope 0.002;' "$scratch/sloped.svg" || complain 'fig4 does not say the slope'
mkdir "$scratch/unnamed" "$scratch/speeds"
sed '1s/.*/Uhr,Ort/' "$scratch/CR.csv" >"$scratch/unnamed/CR.csv"
samples/figures/fig4.sh -K 0.5 -R 0.04 --slope=0.002 --use t=1 --use=x=Ort "$scratch/unnamed/CR.csv" 2>/dev/null |
  cmp - "$scratch/sloped.svg" || complain 'fig4 --use'
cut -d , -f 1,3 samples/CR.csv >"$scratch/speeds/CR.csv"
samples/figures/fig4.sh -K 0.5 -R 0.04 "$scratch/speeds/CR.csv" >"$scratch/speeds.svg"
cp samples/CR.csv "$scratch/speeds"
samples/figures/fig4.sh -c v -K 0.5 -R 0.04 "$scratch/speeds/CR.csv" | cmp - "$scratch/speeds.svg" || complain 'fig4 -c v'
# Of a roll up a mat, and of its mirror image down, the residuals are those of one fit.
for sign in '' -; do
  awk -F, -v OFS=, -v sign="${sign}1" 'NR > 1 && $2 != "" { $2 *= sign } { print }' "$scratch/CR.csv" >"$scratch/speeds/CR.csv"
  samples/figures/residuals.sh -K 0.5 -R 0.04 --slope "${sign}0.002" "$scratch/speeds/CR.csv" >"$scratch/up$sign.svg" ||
    complain "residuals --slope ${sign}0.002"
  sed 's/slope -/slope /' "$scratch/up$sign.svg" | cmp - "$scratch/up.svg" || complain 'residuals: up and down differ'
done
smooth -q --coast -c x -w 1 "$scratch/CR.csv" |
  fitpower -q --route position -K 0.5 -R 0.04 --slope 0.002 | awk '!/^#/ {
    printf "CR:  a = %.3f ± %.3f mm,  b = %.3f ± %.3f\n", 1e3 * $1, 1e3 * $2, $3, $4 }' >"$scratch/said"
grep -qF "$(cat "$scratch/said")" "$scratch/up.svg" || complain "residuals --slope does not say: $(cat "$scratch/said")"
# The law of one run foretells another.
for n in 1 2; do
  simulate --scene samples/CR.toml --v0 0.$((2 + 3 * n)) --sensor pasco --seed $n >"$scratch/foretold$n.csv"
done
samples/figures/residuals.sh -K 0.5 -R 0.04 --by 1 "$scratch"/foretold[12].csv >"$scratch/by.svg" 2>/dev/null ||
  complain 'residuals --by'
grep -q 'dotted: 95 % limits of the law of run 1' "$scratch/by.svg" || complain 'residuals --by has no limits'
[ "$(grep -c "stroke-dasharray" "$scratch/by.svg")" -ge 4 ] || complain 'residuals --by: not four limits'
for wrong_by in '--by 3' '--by x' '--law d0 --by 1'; do
  # shellcheck disable=SC2086
  samples/figures/residuals.sh -K 0.5 -R 0.04 $wrong_by "$scratch"/foretold[12].csv >/dev/null 2>"$scratch/err" &&
    complain "residuals $wrong_by"
done
# What rolled is not guessed.
for figure in fig4 residuals; do
  samples/figures/$figure.sh -K 0.5 "$scratch/CR.csv" >/dev/null 2>"$scratch/err" && complain "$figure guesses R"
  grep -q 'say what rolled: -K 0.5 -R 0.04' "$scratch/err" || complain "$figure: $(cat "$scratch/err")"
done
# The key has every name, a long one without its middle, several without what they have in common; or it
# says how many it has.
names=()
for i in {1..17}; do
  names+=("$scratch/a solid cylinder on the second rubber mat, try no. $((i + 10)).csv")
  cp "$scratch/CR.csv" "${names[-1]}"
done
for n in ${LONG:+4 5 9 16} 1 17; do
  samples/figures/fig4.sh -K 0.5 -R 0.04 "${names[@]:0:n}" >"$scratch/names.svg" || complain "fig4 of $n runs"
  [ "$(grep -oE '<title>(a[^<]*…|…[12][0-9](:|<))' "$scratch/names.svg" | sort -u | grep -c .)" = $((n > 16 ? 16 : n)) ] ||
    complain "fig4 of $n runs: $(grep -o '<title>.*' "$scratch/names.svg")"
done
grep -q 'the key names the first 16 of 17 runs' "$scratch/names.svg" ||
  complain 'fig4 of 17 runs does not say that it names 16'
{ part own 3; part own 4; } | grep -oE '[ML][0-9.]+,[0-9.]+' | tr -d ML | tr ',' ' ' | awk -v frame="$(axes own)" '
  BEGIN { split(frame, f, " ") }
  FNR == NR { a = $1; b = $3; next }
  { if (!n++) { x0 = $1; y0 = $2 } x1 = $1; y1 = $2 }
  END {  # from one speed to another the law grows by their ratio to the power b
    grows = (f[4] - y1) / (f[4] - y0); wide = (x1 - f[1]) / (x0 - f[1])
    exit !(n > 50 && (grows / wide^b - 1)^2 < 1e-4) }' "$scratch/law" - ||
      complain "own run: its law"

# A roll up a slope and back: the points of both ways, and uncertainties that three decimals do not show.
simulate -K 0.4 -R 0.0127 -a 2e-4 -b 0.1 --v0 0.7 --slope 0.03 --until 8 --sensor pasco --seed 5 |
  cut -d , -f 1,2 >"$scratch/ball.csv"
samples/figures/fig4.sh -K 0.4 -R 0.0127 --slope 0.03 "$scratch/ball.csv" >"$scratch/ball.svg" 2>"$scratch/said" &&
  grep -q 'a = 0\.\(1999\|200[01]\) ± 0\.0002 mm,  b = 0\.[0-9]* ± 0\.000[67]' "$scratch/ball.svg" ||
  complain "up and back: $(cat "$scratch/said") $(grep -o 'a = [^<]*' "$scratch/ball.svg" | head -n 1)"
[ "$(grep -c "href='#gpPt" "$scratch/ball.svg")" -gt 150 ] || complain 'up and back: few points'

exit $wrong
