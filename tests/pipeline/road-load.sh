#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# samples/road-load.sh finds the road load with which runs were made, one way and both, on a road that
# rises and in a wind, and corrects it as GTR 15 does.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
root=$PWD
export PATH="$root/bin:$PATH"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 2
wrong=0
complain() { echo "$*" && wrong=1; }
load() { "$root/samples/road-load.sh" "$@" 2>said; }
# is NAME VALUE TOLERANCE: of the table on standard input
is() {
  awk -F '\t' -v name="$1" -v value="$2" -v tolerance="$3" '
    $1 == name { found = 1; if (($2 - value)^2 > (tolerance * value)^2) print name " is " $2 ", not " value }
    END { if (!found) print name " is missing" }' "${4:-table}"
}
are() { while read -r name value tolerance; do complaint=$(is "$name" "$value" "$tolerance"); [ -z "$complaint" ] || complain "$complaint"; done; }

# A car of 150 N, .8 N/(km/h) and .030864198 N/(km/h)^2, that is .4 N s^2/m^2, and 1512 kg: with R = 1
# its law is F/(m g). f* are those of the worked example: w1 2.5 N, K1 1.190476 N, a factor .9312 for
# 12 C and .980541 for 285 K and 99.2 kPa.
awk 'BEGIN { w = 1512 * 9.81; printf "d0[m] d1[s] d2[s^2/m]\n%.17g %.17g %.17g\n", 150 / w, 0.8 * 3.6 / w, 0.030864198 * 12.96 / w }' >car
run() {  # SEED [OPTION]...: in km/h, without a sign, and with a noise of .05 km/h
  simulate --law car -K 0.04 -R 1 --v0 "${v0:-36}" --dt 0.5 --until 90 --columns t,v "${@:2}" |
    awk -v seed="$1" -v size="$size" 'BEGIN { print "Time (s),Speed (km/h)" }
      function uniform() { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
      !/^#/ { sub(/-/, "", $2); printf "%s,%.17g\n", $1, 3.6 * $2 + size * (uniform() - uniform()) }'
}
size=0 && run 1 >out
load -m 1512 --rotating 60.48 --test-mass 1500 -T 12 -p 99.2 --anemometer 2.5 out >table || complain "$(cat said)"
are <<'END'
f0 150 1e-6
f1 0.8 1e-5
f2 0.030864198 1e-5
f0_gtr15 136.2434 1e-6
f1_gtr15 0.744960 1e-5
f2_gtr15 0.0302636 1e-5
END

# In the air of the standard of another rule, at its temperature: its f2 is the one that was measured.
load -m 1512 --rotating 60.48 --standard cfr -T 20 -p 98.21 out >table || complain "$(cat said)"
are <<'END'
f2 0.030864198 1e-5
f2_cfr 0.030864198 1e-5
END

# Both ways on a road that rises by 1 mm a metre: within four standard uncertainties; F of the pairs.
size=0.1
for i in 1 2 3; do run "10$i" --slope 0.001 >"out$i"; run "20$i" --slope -0.001 >"back$i"; done
load -m 1512 --rotating 60.48 out[1-3] --back back1 --back back2 --back back3 >table || complain "$(cat said)"
awk -F '\t' '
  function far(value) { return ($2 - value)^2 > 16 * $3^2 }
  $1 == "f0" && (far(150) || $3 > 3) || $1 == "f1" && far(0.8) || $1 == "f2" && far(0.030864198) || $1 == "slope" && far(0.001)' \
  table | grep . && wrong=1
[ "$(grep -c '^f[012]\|^slope' table)" = 4 ] || complain "not all of them: $(cat table)"
awk -F '\t' '/^# v/ { pairs = 1; next }
  pairs { rows++; F = 150 + 0.8 * $1 + 0.030864198 * ($1^2 + 25 / 3); if ((($4 - F) / F)^2 > 0.01^2 || $3 > 5) print }
  END { if (rows < 7) print rows + 0 " pairs" }' table | grep . && wrong=1
# No pair is below the speeds that all runs have, and none is missing above them.
slowest=$(tail -q -n 1 out[1-3] back[1-3] | cut -d , -f 2 | sort -g | tail -n 1)
tail -n 1 table | awk -v slowest="$slowest" '{ exit !($1 - 5 >= slowest && $1 - 15 < slowest) }' ||
  complain "the last pair, with $slowest km/h at the end: $(tail -n 1 table)"
load -m 1512 --rotating 60.48 out[1-3] --back back[1-3] | cmp - table || complain '--back before all files is another load'

# Runs of both signs are not one way.
awk -F , 'NR == 1 { print; next } { print $1 ",-" $2 }' back1 >signed
load -m 1512 --rotating 60.48 out1 signed >table && complain 'two ways as one'
grep -qx 'road-load.sh: runs both ways: give those of the way back behind --back, or say --slope fit' said || complain "two ways: $(cat said)"
load -m 1512 --rotating 60.48 --slope fit out1 signed >table || complain "two ways with --slope fit: $(cat said)"

# A C_rr that wheels hardly have is told: speeds in km/h that are taken in m/s.
for C_rr in 0.029 0.031; do
  printf 'd0[m] d2[s^2/m]\n%s 2.7e-5\n' $C_rr | simulate --law - -K 0.04 -R 1 --v0 30 --dt 1 --until 50 --columns t,v --digits 6 |
    awk '/^##/ { next } { sub(/^# /, "") } 1' >soft
  load --no-f1 -m 1512 --rotating 60.48 soft >/dev/null
  echo "$C_rr $(grep -c 'C_rr is 0.031: wheels have' said)"
done >table
[ "$(cat table)" = $'0.029 0\n0.031 1' ] || complain "C_rr: $(cat table said)"

# One that no wheel has fails: a run down a slope that is taken for level.
run 104 --slope -0.014 >down
load -m 1512 --rotating 60.48 --no-f1 down >table && complain 'a negative C_rr passes'
[ ! -s table ] && grep -q 'C_rr is -.* Is the road level?' said || complain "C_rr below 0: $(cat table said)"

# A run is named by its file alone: rounded speeds cause a warning that names it.
awk -F , 'NR == 1 { print; next } { printf "%s,%.0f\n", $1, $2 }' out1 >coarse
load -m 1512 --rotating 60.48 coarse >/dev/null
grep -q '^fitpower: run coarse:' said || complain "another name: $(cat said)"

# In a wind of 3 m/s that is fitted; without f1.
size=0.1
awk 'BEGIN { w = 1512 * 9.81; printf "d0[m] d2[s^2/m]\n%.17g %.17g\n", 150 / w, 0.4 / w }' >car
run 31 --wind 3 >out1
run 32 --wind -3 >back1
load --no-f1 --wind fit -m 1512 --rotating 60.48 out1 --back back1 >table || complain "$(cat said)"
awk -F '\t' '
  function far(value) { return ($2 - value)^2 > 16 * $3^2 }
  $1 == "f0" && (far(150) || $3 > 3) || $1 == "wind" && far(3)' table | grep . && wrong=1
[ "$(grep -c '^f[02]\|^wind' table)" = 3 ] || complain "not all of them: $(cat table)"

# Over hills of 3 m, which speed the car up, that were surveyed: the fit finds where the runs begin, and what the survey lacks.
awk 'BEGIN { OFMT = CONVFMT = "%.17g"; pi = atan2(0, -1); print "# x[m]\th[m]"; for (x = -100; x < 2500; x += 10) print x "\t" 3 * sin(2 * pi * x / 800) + 0.0005 * x }' >survey
awk '!/#/ { $2 -= 0.0005 * $1 } { print }' survey >hills
v0=24 run 41 --height survey >there
v0=-24 run 42 --height survey --x0 2400 >here
load --no-f1 --height hills -m 1512 --rotating 60.48 there --back here >table || complain "$(cat said)"
awk -F '\t' '
  function far(value) { return ($2 - value)^2 > 16 * $3^2 }
  $1 == "f0" && (far(150) || $3 > 1) || $1 == "slope" && (far(0.0005) || $3 > 5e-5)' table | grep . && wrong=1
[ "$(grep -c '^f[02]\|^slope' table)" = 3 ] || complain "not all of them: $(cat table)"

on='-m 1512 --rotating 60'
cp out1 run.svg
for words in '' 'out1' '-m 1512 out1' '-m 1512 --rotating x out1' "$on --standard sae out1" "$on nowhere" \
  "$on out1 --back" '-m 1512 --rotating 7.5 out1' "$on --back out1" "$on -T 20 out1" "$on -p 100 out1" \
  "$on --test-mass 1500 out1" "$on -o out1 out1" "$on -o run.svg run.svg"; do
  # shellcheck disable=SC2086
  load $words >table && complain "accepted: $words"
  [ ! -s table ] && [ -s said ] || complain "$words: $(cat table said)"
done
load $on --back out1 >/dev/null
grep -q 'write OUT... in front of it' said || complain "all behind --back: $(cat said)"
load $on -T 20 out1 >/dev/null
grep -qx 'road-load.sh: -T needs -p' said || complain "-T alone: $(cat said)"
load -m 1512 --rotating 7.6 out1 >/dev/null || complain "light wheels: $(cat said)"
cmp out1 run.svg || complain 'a run is overwritten'
load $on out1 --back out1 >/dev/null
grep -q 'those of an earlier run' said || complain "a run and its copy both ways: $(cat said)"
load $on out1 >/dev/null
grep -q 'runs one way: the road is taken for level' said || complain "one way: $(cat said)"
# Numbers in other units: tonnes, a mass above that of the car, kelvin, pascal, hectopascal; and the limits.
while read -r refused option limits; do
  # shellcheck disable=SC2086
  load -m 1512 --rotating 60 out1 ${refused/=/ } 2>&1
  grep -q "^road-load.sh: $option [(].* ${refused#*=}: from $limits" said || complain "$refused: $(cat said)"
done <<'END' >/dev/null
-m=1.5 -m 5 to 1e7
--rotating=1513 --rotating 0 to 1512
-T=293 -T -60 to 60
-T=-61 -T -60 to 60
-p=101325 -p 30 to 110
-p=29 -p 30 to 110
END
for words in '-T 60 -p 110' '-T -60 -p 30'; do
  # shellcheck disable=SC2086
  load -m 1512 --rotating 0 out1 $words >/dev/null || complain "$words: $(cat said)"
done
if command -v gnuplot >/dev/null; then
  load --no-f1 -m 1512 --rotating 60.48 -o force.svg out1 --back back1 >/dev/null || complain "$(cat said)"
  grep -q '</svg>' force.svg || complain 'no figure'
fi
exit $wrong
