#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# road-load.sh -m MASS --rotating KG [OPTION]... OUT... [--back FILE...]: prints the road load of a
# vehicle, F = f0 + f1 v + f2 v^2, with standard uncertainties, from the coast-downs of a test day.
#
#   OUT...           runs one way: time and speed, in the units of their header (km/h, mph, m/s)
#   --back FILE...   runs the other way, with speeds without a sign: all files that follow
#   -m MASS          mass of the vehicle, the mean of the day [kg]
#   --rotating KG    equivalent mass of the rotating parts [kg]: the sum of I/r^2 of the wheels, or, by
#                    GTR 15, 3 % of the mass in running order and 25 kg
#   --no-f1          F = f0 + f2 v^2: if f1 is 0, f0 and f2 come out seven times more precisely
#   --slope S|fit    slope along OUT, to which --height adds (fitted if there is --back, else 0)
#   --height FILE    height of the road [m] over the way x [m]. Hills speed a car up, so that the runs are
#                    fitted as they are: cut them to the coast; --x0 X,...: x of their first rows (fitted)
#   --wind W|fit     head wind of OUT [m/s]; fit finds one wind for all runs
#   --column NAME=COLUMN   use this column as t or v, as --use of the tools; may be repeated
#   -T C -p KPA      temperature and pressure of the day: prints C_d A and the load at the standard too
#   --standard NAME  gtr15 (20 C, 100 kPa) or cfr (40 CFR 1066.805: 20 C, 98.21 kPa)
#   --test-mass TM   mass of the standard [kg] (MASS)
#   --anemometer W   measured mean speed of the wind [m/s] (0), if it is not fitted
#   -o FILE.svg      draws the force over the speed, with its 95 % band (needs gnuplot)
#
# fitpower fits the free coasts that smooth --coast finds: there are no differences of speeds and no
# chosen intervals of speed. Below the load stand the times of the pairs of runs, each OUT with its
# --back, and their statistical precision p (GTR 15: below 3 %).
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
standard=gtr15 anemometer=0 law='d0+d1*v+d2*v^2'
options '-m --rotating --no-f1! --back! --slope --height --x0 --wind --column... -T -p --standard --test-mass
  --anemometer -o' "$@"
[ -z "$no_f1" ] || law='d0+d2*v^2'
[ ${#operands[@]} -gt 0 ] || wrong 'there is no run'
[ "$back" != ${#operands[@]} ] || wrong '--back needs the files of the way back'
out=("${operands[@]:0:${back:-${#operands[@]}}}") back=("${operands[@]:${#out[@]}}")
TM=$test_mass measured=$anemometer svg=$o
[ ${#out[@]} -gt 0 ] || wrong '--back takes all files that follow it: write OUT... in front of it'
[ "$m" ] && [ "$rotating" ] || wrong 'say the masses in kg: -m 1500 --rotating 60, or --rotating 0'
for number in "$m" "$rotating" "$T" "$p" "$TM" "$measured"; do
  [ -z "$number" ] || is_number "$number" || wrong "$number is not a number"
done
# within NAME VALUE LEAST MOST: refuses a value beyond these, which is probably in another unit.
within() {
  [ -z "$2" ] || awk "BEGIN { exit !($2 >= $3 && $2 <= $4) }" || wrong "$1 $2: from $3 to $4"
}
within '-m (kg)' "$m" 5 1e7
within '--rotating (kg)' "$rotating" 0 "$m"
within '-T (degrees Celsius)' "$T" -60 60
within '-p (kPa)' "$p" 30 110
case $standard in
  gtr15) pressure=100 ;;
  cfr) pressure=98.21 ;;
  *) wrong "--standard $standard: gtr15 or cfr" ;;
esac
! awk "BEGIN { exit !($rotating > 0 && $rotating < $m / 200) }" ||
  wrong "--rotating $rotating is less than 0.5 % of -m $m: both are in kg, and wheels have 1 to 5 %"
for option in $chosen; do
  case $option in
    -T | -p | --standard | --test-mass | --anemometer)
      [ "$T" ] || wrong "$option needs -T"
      [ "$p" ] || wrong "$option needs -p" ;;
    -o)
      [ "${svg%.svg}" != "$svg" ] || wrong "-o $svg: the figure is an SVG, FILE.svg"
      for file in "${operands[@]}"; do
        [ ! "$svg" -ef "$file" ] || wrong "-o $svg would replace a run"
      done ;;
  esac
done
[ "$slope" ] || [ ${#back[@]} = 0 ] || slope=fit
one_way=''
[ "$slope$height" ] || { slope=0 && one_way=1; }
road=(${height:+--height "$height"} ${x0:+--x0 "$x0"} ${slope:+--slope "$slope"})
[ "$wind" != fit ] || [ "$measured" = 0 ] || wrong '--wind fit: the wind is corrected by the fit, not by --anemometer'
select=(--coast)
[ -z "$height" ] || select=(-w 1)
make_scratch

# The free coast of each run. With -R 1 a law D is the force over the weight: D = F/(m g).
number=0
coast() {  # FILE WAY
  number=$((number + 1))
  printf '## run %s\n' "$(printf %s "${1##*/}" | tr '[:cntrl:]' '?')"
  smooth "${select[@]}" -c v ${column[@]+"${column[@]/#/--use=}"} -- "$1" | awk -F '\t' -v way="$2" '
    /^## run / { next }
    /^##/ { print; next }
    /^# / { sub(/^# /, ""); for (i = 1; i <= NF; i++) { if ($i ~ /^t\[/) t = i; if ($i ~ /^v\[/) v = i }
      print "# t[s]\tv[m/s]"; next }
    NF { print $t "\t" (way < 0 && $v !~ /^-/ ? "-" : "") $v }'
}
for i in "${!out[@]}"; do
  [ "$i" = 0 ] || echo
  coast "${out[i]}" 1
done >"$scratch/runs"
for file in ${back[@]+"${back[@]}"}; do echo; coast "$file" -1; done >>"$scratch/runs"
if [ "$one_way" ]; then
  ! awk -F '\t' '!/^#/ && NF { $2 < 0 ? down = 1 : up = 1 } END { exit !(up && down) }' "$scratch/runs" ||
    wrong 'runs both ways: give those of the way back behind --back, or say --slope fit'
  echo "road-load.sh: runs one way: the road is taken for level; those of the way back go behind --back" >&2
fi
K=$(awk "BEGIN { print $rotating / $m }")
fit() {
  fitpower --route velocity --law "$law" -K "$K" -R 1 ${wind:+--wind "$wind"} "${road[@]}" "$@"
}
# The check says whether f1 may be left out.
fit ${no_f1:+--check} "$scratch/runs" >"$scratch/row" || [ -s "$scratch/row" ] || exit 2

awk -F '\t' '/^# d0/ { next } /^[^#]/ && ($1 < 3e-4 || $1 > 0.03) { printf "C_rr is %.2g: wheels have 0.0005 to 0.025; is the unit of the speed in the header, and the wind in m/s? Is the road level?\n", $1 }' \
  "$scratch/row" >"$scratch/doubt"
[ ! -s "$scratch/doubt" ] || echo "road-load.sh: $(cat "$scratch/doubt")" >&2
! grep -q 'C_rr is -' "$scratch/doubt" || exit 1

# The numbers of the row in newtons and km/h; and, after GTR 15, Annex 4, those at the standard:
# f0* = (f0 - w1 - K1)(1 + K0 (T - 20)), f1* = f1 (1 + K0 (T - 20)), f2* = K2 f2, with K0 = 8.6e-3/K,
# K1 = f0 (1 - TM/m), K2 = (T/293 K)(standard pressure/p), w1 = f2 w^2 where no wind is fitted.
awk -F '\t' -v m="$m" -v T="$T" -v p="$p" -v pressure="$pressure" -v TM="${TM:-$m}" -v measured="$measured" \
  -v standard="$standard" '
  /^##/ { next }
  /^# / { sub(/^# /, ""); for (i = 1; i <= NF; i++) name[i] = $i; next }
  { for (i = 1; i <= NF; i++) { plain = name[i]; sub(/\[.*/, "", plain); at[plain] = $i } }
  function line(name, value, sigma, unit) { printf "%s\t%.7g\t%s\t%s\n", name, value, (sigma == "" ? "" : sprintf("%.2g", sigma)), unit }
  END {
    weight = m * 9.81
    per[0] = 1; per[1] = 1 / 3.6; per[2] = 1 / 12.96
    unit[0] = "N"; unit[1] = "N/(km/h)"; unit[2] = "N/(km/h)^2"
    print "# quantity\tvalue\tsigma\tunit"
    for (k = 0; k < 3; k++) {
      if (!(("d" k) in at)) continue
      f[k] = weight * per[k] * at["d" k]; s[k] = weight * per[k] * at["sigma_d" k]
      line("f" k, f[k], s[k], unit[k])
    }
    for (k = 1; k < 3; k++) for (j = 0; j < k; j++) if (("corr_d" j "_d" k) in at) line("corr_f" j "_f" k, at["corr_d" j "_d" k], "", "")
    line("C_rr", at["d0"], at["sigma_d0"], "")
    if ("slope" in at) line("slope", at["slope"], at["sigma_slope"], "")
    if ("wind" in at) line("wind", at["wind"], at["sigma_wind"], "m/s")
    if (T == "" || p == "") exit
    kelvin = T + 273
    density = 1000 * p / (287.05 * kelvin)
    line("C_d A", 2 * f[2] * 12.96 / density, 2 * s[2] * 12.96 / density, "m^2")
    warmth = 1 + 8.6e-3 * (T - 20)
    scale[0] = warmth * TM / m; scale[1] = warmth; scale[2] = kelvin / 293 * pressure / p
    w1 = 12.96 * f[2] * measured^2
    for (k = 0; k < 3; k++) if (k in f) line("f" k "_" standard, scale[k] * f[k] - (k ? 0 : warmth * w1), scale[k] * s[k], unit[k])
  }' "$scratch/row"

# The pairs: each run under its own law, on the road and in the wind that all have, as long as it was
# measured, and its time from 5 km/h above to 5 km/h below each speed.
ends() {  # RUN: its last time
  awk -F '\t' -v run="## run $1" '/^## run / { on = $0 == run } on && !/^#/ && NF { t = $1 } END { print t }' "$scratch/runs"
}
pairs() {
  value() { columns "$scratch/row" "$1"; }
  [ "$slope" != fit ] || road=(--slope="$(value slope)")
  [ "$wind" != fit ] || wind=$(value wind)
  fit -q --each "$scratch/runs" >"$scratch/rows"
  sed -n 's/^## run //p' "$scratch/runs" | while IFS= read -r run; do
    simulate -q --law "$scratch/rows" --run "$run" --dt 0.1 --until "$(ends "$run")" --columns t,v
  done | awk -F '\t' -v n=${#out[@]} -v moving="$(awk "BEGIN { print $m + $rotating }")" '
    function took(run, speed) {  # from 5 km/h above to 5 km/h below; 0 if the run has not both
      if (!((run, speed - 5) in time && (run, speed + 5) in time)) return 0
      return time[run, speed - 5] - time[run, speed + 5]
    }
    /^## simulate/ { run++; first = 1; next }
    /^#/ || !NF { next }
    { v = 3.6 * ($2 < 0 ? -$2 : $2)
      for (mark = 5 * int(last / 5); !first && mark >= v && mark > 0; mark -= 5)
        time[run, mark] = before + ($1 - before) * (last - mark) / (last - v)
      if (v > top) top = v
      before = $1; last = v; first = 0 }
    END {
      students = split("12.7 4.30 3.18 2.78 2.57 2.45 2.36 2.31 2.26 2.23 2.20 2.18 2.16 2.14 2.13", h, " ")
      print "\n# v[km/h]\tdt[s]\tp[%]\tF[N]"
      for (speed = 10 * int(top / 10); speed >= 10; speed -= 10) {
        sum = squares = 0
        for (pair = 1; pair <= n; pair++) {
          if (!took(pair, speed) || !took(n + pair, speed)) break
          dt[pair] = 2 / (1 / took(pair, speed) + 1 / took(n + pair, speed))
          sum += dt[pair]
        }
        if (pair <= n) continue
        mean = sum / n
        for (pair = 1; pair <= n; pair++) squares += (dt[pair] - mean)^2
        student = n > students ? 2 : h[n - 1]
        precision = 100 * student * sqrt(squares / (n - 1) / n) / mean
        printf "%d\t%.4g\t%.2g\t%.5g\n", speed, mean, precision, moving * 10 / 3.6 / mean
      }
    }'
}
: >"$scratch/pairs"
[ "$height" ] || [ ${#out[@]} != ${#back[@]} ] || [ ${#out[@]} -lt 2 ] ||
  pairs | tee "$scratch/pairs"
[ "$svg" ] || exit 0

# The force in still air with its 95 % band, and that of the pairs, which the law was not fitted to.
command -v gnuplot >/dev/null || wrong 'gnuplot is not installed; make setup figures installs it'
awk -F '\t' '/^#/ || !NF { next } { v = $2 < 0 ? -$2 : $2; if (v > top) top = v }
  END { print "# t[s]\tv[m/s]"; for (i = 0; i <= 200; i++) print i "\t" top * (i + 0.2) / 201 }' \
  "$scratch/runs" >"$scratch/grid"
energy-ledger -q --law "$scratch/row" ${wind:+--wind 0} -m "$m" --columns D,sigma_D "$scratch/grid" |
  awk -F '\t' -v weight="$(awk "BEGIN { print $m * 9.81 }")" '!/^#/ && NF {
    print 3.6 * $2, weight * $3, weight * ($3 - 1.96 * $4), weight * ($3 + 1.96 * $4) }' >"$scratch/band"
{ echo 'NaN NaN NaN NaN' && grep -v '^#' "$scratch/pairs"; } >"$scratch/points" || true
(cd "$scratch" && gnuplot) >"$scratch/drawn" <<'PLOT'
set terminal svg size 620, 420 background 'white' font 'sans,13'
set xlabel 'speed v / (km/h)'; set ylabel 'force F / N'
set xrange [0:]; set yrange [0:]; set key top left Left reverse; set grid lc rgb '#dddddd'
plot 'band' using 1:3:4 with filledcurves lc rgb '#9ecae1' title '95 % of the law', \
  'band' using 1:2 with lines lc rgb '#08519c' lw 1.5 title 'F = f0 + f1 v + f2 v^2, still air', \
  'points' using 1:4 with points pt 7 ps 0.6 lc rgb '#d95f0e' title 'pairs of runs'
PLOT
[ ! -e "$svg" ] || [ -f "$svg" ] || wrong "$svg is no file"
replace=1
mkdir "$scratch/picture" && mv "$scratch/drawn" "$scratch/picture/${svg##*/}"
place "$(dirname -- "$svg")" "$scratch/picture"/*
