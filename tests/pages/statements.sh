#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Statements of the pages that a command can show, each with the page that makes it.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
PATH=$PWD/bin:$PATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
# below WHAT NUMBER LIMIT
below() { awk -v x="$2" -v limit="$3" 'BEGIN { exit !(x != "" && x ^ 2 < limit ^ 2) }' || complain "$1: $2, not below $3"; }
last_of() { tail -n 1 | cut -f "$1"; }
of_scene() { sed -n "s/^$1 = //p" "samples/$2.toml"; }
# says PAGE TEXT: the page still makes the statement, line ends aside.
says() {
  tr '\n' ' ' <"$1" | sed 's/\\ / /g; s/\\(ha/^/g; s/  */ /g' | grep -qF -e "$2" || complain "$1 does not say: $2"
}

# energy-ledger(1): closure and imbalance of simulated rows.
says man/energy-ledger.1 'below 1e-7 with a row every 0.01 s, 4e-6 every 0.04 s and 5e-5 every 0.1 s'
says man/energy-ledger.1 'those of the momenta below 1e-5, 1e-4 and 7e-4'
says man/energy-ledger.1 'below 2e-4, 8e-4 and 2e-3 in these scenes with b = -0.3'
for scene in CF CR SF SR; do
  while read -r dt limit negative momenta; do
    for law in "" "-b -0.3"; do
      # shellcheck disable=SC2086  # two words
      simulate --scene samples/$scene.toml $law --dt "$dt" |
        energy-ledger --scene samples/$scene.toml ${law:+-a $(of_scene coefficient $scene) $law} --summary |
        tail -n 1 >"$scratch/row"
      below "imbalance of $scene, dt $dt $law" "$(last_of 5 <"$scratch/row")" "$([ "$law" ] && echo $negative || echo $limit)"
      [ "$law" ] || below "closure_p of $scene, dt $dt" "$(last_of 6 <"$scratch/row")" "$momenta"
    done
  done <<<'0.01 1e-7 2e-4 1e-5
0.04 4e-6 8e-4 1e-4
0.1 5e-5 2e-3 7e-4'
done

# rolling(7): the law that the first example gives, in words.
cut -d , -f 1,2 samples/CR.csv >"$scratch/run.csv"
says man/rolling.7 "$(smooth -q --coast "$scratch/run.csv" | fitpower -q -K 0.5 -R 0.04 | awk '!/^#/ {
  printf "So a = (%.2f \\(+- %.2f) mm is the shift D at 1 m/s, and b = %.3f \\(+- %.3f.", 1e3 * $1, 1e3 * $2, $3, $4 }')"

# smooth(1): what half a second of rest brings, in 12 runs.
says man/smooth.1 'rows up to half a second after the stop .Pq Fl Fl from , Fl Fl to make sigma_b a third smaller'
for seed in $(seq 12); do
  simulate --scene samples/CR.toml --sensor pasco --seed "$seed" >"$scratch/run.csv"
  smooth -q --coast -c x "$scratch/run.csv" >"$scratch/roll"
  read -r from to <<<"$(awk '!/^#/ { last = $1; first = first == "" ? last : first } END { print first, last + 0.5 }' "$scratch/roll")"
  fitpower -q -K 0.5 -R 0.04 "$scratch/roll" | tail -n 1
  smooth -q --from "$from" --to "$to" -c x "$scratch/run.csv" | fitpower -q -K 0.5 -R 0.04 | tail -n 1
done | awk 'NR % 2 { roll += $4; next } { rest += $4; squares += (($3 - 0.215) / $4)^2 }
  END { print rest / roll, squares; exit !(NR == 24 && rest / roll > 0.55 && rest / roll < 0.75 && squares < 26) }' ||
  complain 'rows of the rest do not bring what smooth(1) says'

# README: the row of its first command in words, with C_rr; and of what the samples were made.
says README.md "$(smooth -q --coast samples/CR.csv | fitpower -q -K 0.5 -R 0.04 | awk '!/^#/ {
  printf "**D = %.2f(%.0f) mm · (v in m/s)^%.3f(%.0f).** Extrapolated to 1 m/s, the force of the mat acts %.2f mm ahead of the lowest point, and C_rr = D/R = %.3f.",
    1e3 * $1, 1e5 * $2, $3, 1e3 * $4, 1e3 * $1, $1 / 0.04 }')"
says README.md "$(awk '/^coefficient/ { a = $3 } /^exponent/ { b = $3 }
  END { printf "**All samples are simulated**, from a and b of the paper: here %.2f mm and %s.", 1e3 * a, b }' samples/CR.toml)"
# Its line of a road load is that of the recipe, which runs.
says README.md "$(awk '$1 == "f0" && $4 == "N" { printf "`f0 %.1f %s N`", $2, $3; exit }' man/rolling-recipes.7)"

# What table1.sh prints says that its runs are simulated, and by how much one body's law is wrong for the other.
samples/table1.sh >"$scratch/table1" || complain 'table1.sh fails'
head -n 1 "$scratch/table1" | grep -q "which were simulated from the paper's values" || complain 'table1: of what are its runs?'
awk '/^  CR   SR/ { less = -$5 } /^  SR   CR/ { more = $5 }
  END { printf "takes %.0f %% too much from the shell, and the shell'"'"'s law %.0f %% too little", 100 * more, 100 * less }' \
  "$scratch/table1" >"$scratch/off"
says "$scratch/table1" "$(cat "$scratch/off")"

# rolling(7): a header without a unit, and decimal commas between commas.
says man/rolling.7 "--use \\(aqv=Speed[km/h]\\(aq"
[ "$(printf 'Time (s),Speed\n0,36\n1,18\n' | differentiate -q --use 'v=Speed[km/h]' --digits 3 | tail -n 1)" = "$(printf '1\t5\t-5')" ] ||
  complain "--use v=Speed[km/h]"
printf 't,v\n0,5,1,5\n' | differentiate 2>&1 | grep -q 'fields under a line of 2 names' || complain 'decimal commas between commas'

# rolling-motion(7), shift-from-accel(1): A = 1 beside the exact geometry.
says man/rolling-motion.7 "0.054 % or less at 0.5 m/s, and 0.005 to 0.035 % of the time to the stop"
says man/shift-from-accel.1 '0.054 % for the cylinder on rubber at 0.5 m/s'
for scene in CF CR SF SR; do
  stop() { simulate --scene samples/$scene.toml --columns t "$@" | last_of 1; }
  awk -v t="$(stop)" -v exact="$(stop --exact)" 'BEGIN { off = t / exact - 1; exit !(off > 0.45e-4 && off < 3.55e-4) }' ||
    complain "$scene: the time to the stop with A = 1"
done
for scene in CF CR SF SR; do
  force() { printf 't\n0\n' | simulate --scene samples/$scene.toml --at - | energy-ledger --scene samples/$scene.toml --columns F_H "$@" | last_of 6; }
  awk -v approximate="$(force)" -v exact="$(force --exact)" 'BEGIN { exit !((exact / approximate - 1)^2 < 5.45e-4^2) }' ||
    complain "$scene: F_H with A = 1"
done
says man/rolling-motion.7 '2.5 to 6.1 % of that on rubber between 0.5 and 0.02 m/s'
awk 'BEGIN { low = 4e-5 / (1.87e-3 * 0.5^0.215); high = 4e-5 / (1.78e-3 * 0.02^0.255)
  exit !(low > 0.0245 && low < 0.0255 && high > 0.0605 && high < 0.0615) }' || complain 'slope and D on rubber'
says man/rolling-motion.7 '0.027 for the cylinder on rubber at 0.5 m/s'
simulate --scene samples/CR.toml | energy-ledger --scene samples/CR.toml --columns F_H,F_N | awk '
  /^0\t/ { needs = -$6 / $7 } END { exit !(needs > 0.0265 && needs < 0.0275) }' || complain 'static friction'

# smooth(1): the noise of savgol inside and at the ends, from its weights: unit impulses, a run each.
says man/smooth.1 '1.5 s/sqrt(N); at the very ends 3 s/sqrt(N) for order 2 and 4 s/sqrt(N) for order 3'
while read -r order end; do
  awk 'BEGIN { for (k = 0; k < 201; k++) { for (i = 0; i < 201; i++) print i, (i == k); print "" } }' |
    smooth -q -M savgol -w 201 --order "$order" | awk -v end="$end" '
      /^[0-9]/ { if ($1 == 0) ends += $2^2; if ($1 == 100) inside += $2^2 }
      END { ends = sqrt(201 * ends); inside = sqrt(201 * inside)
        exit !(ends / end > 0.97 && ends / end < 1.03 && inside > 1.47 && inside < 1.53) }' ||
    complain "smooth -M savgol --order $order: another noise"
done <<<'2 3
3 4'

# smooth(1), fitpower(1), rolling(7): defaults.
run=$scratch/run.csv
cut -d , -f 1,2 samples/CR.csv >"$run"
cmp -s <(smooth -q "$run") <(smooth -q -w 11 -M mean "$run") || complain 'smooth: another default'
cmp -s <(smooth -q --coast "$run") <(smooth -q --coast -w 1 "$run") || complain 'smooth --coast smooths'
smooth -q --coast -c x samples/CR.csv >"$scratch/roll"
cmp -s <(fitpower -q -K 0.5 -R 0.04 "$scratch/roll") \
  <(fitpower -q -K 0.5 -R 0.04 -g 9.81 --slope 0 --route position "$scratch/roll") ||
  complain 'fitpower: another default'

# smooth(1): a window of seconds reaches a sixteenth of a step beyond its half.
says man/smooth.1 'and 1/16 of a step'
for step in 1.06 1.07; do
  awk -v h="$step" 'BEGIN { print "t v"; print 0, 0; print h, 3; print 2 * h, 9 }' | smooth -q --seconds 2 | sed -n '4p' | cut -f 2
done | tr '\n' ' ' | grep -qx '4 3 ' || complain 'smooth --seconds: another reach'

# rolling-recipes(7): what a fast roll is worth, by the table of its example, which man-examples.sh runs.
says man/rolling-recipes.7 'one roll from 0.8 m/s is worth nine from 0.5 m/s'
awk '/^0\.5 / { slow = $2 } /^0\.8 / { fast = $2 } END { rolls = (slow / fast)^2; exit !(rolls > 8.5 && rolls < 9.5) }' \
  man/rolling-recipes.7 || complain 'another number of slow rolls is worth a fast one'

# rolling-recipes(7): both directions are one fit, if the speeds of the way back are negative.
says man/rolling-recipes.7 'if the speeds of the way back are negative'
for slope in 0.001 -0.001; do
  printf 'd0[m] d2[s^2/m]\n0.0102 2.72e-5\n' | simulate --law - -K 0.04 -R 1 --v0 33 --dt 1 --until 90 --columns t,v --slope=$slope |
    awk -F '\t' -v OFS='\t' -v slope=$slope '!/^#/ && slope < 0 { $2 = -$2 } { print }' >"$scratch/way$slope"
done
fitpower -q --law d0+d2*v^2 -K 0.04 -R 1 --slope fit --digits 3 "$scratch/way0.001" "$scratch/way-0.001" |
  awk -F '\t' '!/^#/ { found = $8 } END { exit !(found > 0.00099 && found < 0.00101) }' || complain 'the slope of a road, both ways'
sed 's/\t-/\t/' "$scratch/way-0.001" >"$scratch/unsigned"
fitpower -q --law d0+d2*v^2 -K 0.04 -R 1 --slope fit "$scratch/way0.001" "$scratch/unsigned" >/dev/null 2>&1 &&
  complain 'speeds without a sign determine a slope'

# fitpower(1): coverage of noise alone, as `make coverage` writes it: of the rows in which few runs are
# told, loglog and runs that scatter aside, and what rolling-fits(7) excepts: few rows, and rounding alone.
says man/fitpower.1 'the 95 % intervals hold the truth in 92 to 97 % of runs, or there is a warning'
awk '/ (position|velocity|shift) +[A-Zb]/ && NF > 24 && $(NF - 4) < 0.2 && !/scatter|[568] rows|no other noise|to 1 cm/ {
    for (i = NF - 12; i <= NF - 8; i += 4) { n++; if ($i < 0.915 || $i >= 0.98) { print; bad = 1 } } }
  END { exit bad || n < 80 }' samples/coverage.txt || complain 'coverage.txt: another coverage'

# rolling-fits(7): what a run does not show, as `make coverage` writes it; the names are those of the page.
sed -n '/^# trouble/,/^# Which law/p' samples/coverage.txt |
  sed 's/^nothing/good   /; s/^viscous drag 0.02\/s/drag of 0.02\/s/; s/^scale of the sensor/scale/
    s/^eccentricity 30/eccentric by 30/; s/^sensor 5 cm off the/sensor 5 cm off/' >"$scratch/troubles"
awk 'NR == FNR { if (match($0, / C[RF] /)) held[substr($0, 1, 15) substr($0, RSTART + 1, 2)] = $(NF - 12); next }
  /^(good|mat|K 3|hand|noise AR[^ ]*|eccentric|drag|sensor|scale) / { name = substr($0 "               ", 1, 15)
    sub(/^.{20}/, ""); n++
    if ($2 - held[name "CR"] > 0.0051 || held[name "CR"] - $2 > 0.0051 || $4 - held[name "CF"] > 0.0051 || held[name "CF"] - $4 > 0.0051) { print name; bad = 1 } }
  END { exit bad || n != 10 }' "$scratch/troubles" <(sed -n '/^good /,/^\.Ed/p' man/rolling-fits.7) ||
  complain 'rolling-fits(7): the shares are not those of coverage.txt'

# fitpower(1): an arc of 3 m by exact heights at so many points, and D = 0.5 mm v^0.2 without noise.
says man/fitpower.1 'with fewer than nine points it may bias the law'
arc() { awk -v n="$1" 'BEGIN { print "x\th"; for (i = 0; i < n; i++) { x = -1.2 + 2.4 * i / (n - 1); printf "%.17g\t%.17g\n", x, 3 * (1 - cos(x / 3)) } }'; }
arc 241 >"$scratch/fine"
simulate -q -K 0.5 -R 0.04 -a 5e-4 -b 0.2 --v0 0.6 --x0 -0.5 --height "$scratch/fine" --until 3.8 --dt 0.04 --columns t,x >"$scratch/rolled"
for n in 7 9; do
  arc $n >"$scratch/few"
  fitpower -q -K 0.5 -R 0.04 --height "$scratch/few" "$scratch/rolled" 2>/dev/null | grep -v '#' | cut -f 3
done | paste -s - | awk '{ exit !($1 < 0.15 && $2 > 0.19 && $2 < 0.21) }' || complain 'heights of few points'

# rolling(7): each of the ten warnings is one of the tools.
grep -c '^\.It Ql' man/rolling.7 | grep -qx 10 || complain 'rolling(7): not ten warnings'
sed -n 's/^\.It Ql //p' man/rolling.7 | sed 's/\\(aq/'"'"'/g; s/ \.\.\..*//; s/^\(there is no column\).*/\1/; s/^fields //' >"$scratch/told"
while read -r text; do
  cat lib/*/*.cpp cmd/*.cpp | tr -d '\n' | sed 's/" *"//g' >"$scratch/code"
  case $text in 'D is') continue ;; esac  # its numbers are between its words
  grep -qF -e "$text" "$scratch/code" || complain "rolling(7): no tool says '$text'"
done <"$scratch/told"

# rolling-columns(5): the limits, each from either side.
limit() {  # WHAT STATUS WANTED
  [ "$2" = "$3" ] || complain "$1: status $2, not $3"
}
says man/rolling-columns.5 'has at most 1048576 bytes'
says man/rolling-columns.5 'N significant digits, 1 to 17'
for more in 0 1; do
  { echo 't v c'; head -c $((1048576 - 5 + more)) /dev/zero | tr '\0' x | sed 's/^/0 1 /'; echo; } |
    smooth -w 1 >/dev/null 2>&1
  limit "a line of 1048576 + $more bytes" $? $((2 * more))
  printf 't v\n0 1\n' | smooth -w 1 --digits $((17 + more)) >/dev/null 2>&1
  limit "--digits 17 + $more" $? $((2 * more))
done

# simulate(1): the table of tests/reference.
says man/simulate.1 'with 113 rolls'
[ "$(tail -n +2 tests/reference/rolls.tsv | cut -f 2-10 | sort -u | wc -l)" -eq 113 ] || complain 'rolls.tsv: not 113 rolls'
exit $wrong
