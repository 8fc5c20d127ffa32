#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Five coast-downs that others recorded: which law is adequate, with what errors. What is checked
# does not come from the fit that it checks: another route, a figure of the record's owners, or the
# reckoning of the way.
set -eu
export LC_ALL=C
unset CDPATH
data=${REAL_DATA:-}
[ -r "$data/kart-coastdown-1hz/Michelin60A.csv" ] ||
  { echo "skipped: REAL_DATA names no folder with kart-coastdown-1hz; see tests/recordings.md";
    exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*"; wrong=1; }
row() { grep -v '^#' "$1"; }
fit() {  # NAME OPTION...
  local name=$1
  shift
  fitpower -q --report "$@" >"$scratch/$name.row" 2>"$scratch/$name.report"
  echo "$name: $(cut -f1-4 "$scratch/$name.row" | tail -n 1)"
  tail -n 1 "$scratch/$name.report"
}

# Kart, km/h once a second, two directions in one fit; the route through D agrees with the
# trajectory, and the balance closes when D is the measured one.
kart() { awk '{ print NR - 1, $1 / 3.6 }' "$data/kart-coastdown-1hz/Michelin60$1.csv"; }
shifts() { kart "$1" | smooth -w 11 | differentiate | shift-from-accel -K 0 -R 0.15; }
{ kart A; echo; kart B; } >"$scratch/kart"
fit kart --route velocity -K 0 -R 0.15 "$scratch/kart"
{ shifts A | fitpower -q; kart A | fitpower -q --route velocity -K 0 -R 0.15; } |
  awk '!/^#/ { b[++n] = $3; s[n] = $4 }
    END { d = b[1] - b[2]; exit !(n == 2 && d * d < 9 * (s[1]^2 + s[2]^2)) }' ||
      complain "kart: the routes do not agree"
# Records come once a second, so that at a moment the balance is less exact than at the end.
for way in A B; do
  shifts $way | energy-ledger -q -m 76 -K 0 -R 0.15 --summary --check 0.02 |
    awk '!/^#/ { exit !($4 * $4 < 1e-4) }' || complain "kart $way: the balance does not close"
done
grep -q 'no law that was tried is better than' "$scratch/kart.report" ||
  complain "kart: the law of the trajectory is not adequate"
# The two directions on one street: with a slope shared by both the fit is better by far, and both
# directions have a and b in common; by themselves they are 2 standard errors apart in a, and the
# joint fit without a slope leaves half as much again.
{ kart A; echo; kart B | awk '{ print $1, -$2 }'; } >"$scratch/street"
fit level --route velocity -K 0 -R 0.15 "$scratch/street"
fit street --route velocity -K 0 -R 0.15 --slope fit "$scratch/street"
{ row "$scratch/level.row"; row "$scratch/street.row"; } |
  awk '{ rms[NR] = $6; S = $8; sigma = $9 }
    END { printf "kart: slope %.2g +- %.1g\n", S, sigma;
      exit !(rms[2] < 0.8 * rms[1] && S > 4 * sigma && S < 1e-3) }' ||
  complain "kart: the slope of the street"
grep -q 'no law that was tried is better than' "$scratch/street.report" ||
  complain "kart: the law is not adequate on a street with a slope"

# The road load of the kart, F = f0 + f1 v + f2 v^2 (rolling-recipes(7)), of both directions in one
# fit: over each minute it is the mass of 76 kg times what the speed has lost, by means of 30 s at its
# ends, the mean of the directions, in which the slope falls out. The scatter of 0.35 m/s, which hangs
# together from row to row, leaves 5 % of it.
fitpower -q --route velocity --law 'd0+d1*v+d2*v^2' -K 0 -R 0.15 --slope fit "$scratch/street" |
  grep -v '^#' >"$scratch/load"
for way in A B; do kart $way | sed "s/^/$way /"; done | awk '
  FNR == NR { f = 76 * 9.81 / 0.15; f0 = f * $1; f1 = f * $3; f2 = f * $5; next }
  { v[$1, $2] = $3 }
  END {
    for (from = 0; from <= 60; from += 30) {
      load = lost = 0
      for (t = from; t < from + 30; t++)
        for (way = 65; way <= 66; way++) {
          w = sprintf("%c", way)
          lost += 76 * (v[w, t] - v[w, t + 60]) / 60 / 60
          for (i = t; i < t + 60; i++) load += (f0 + f1 * v[w, i] + f2 * v[w, i]^2) / 60 / 60 }
      printf "kart: road load in the minute from %d s on %.2f N, by the speeds %.2f N\n", from, load, lost
      bad = bad || (load / lost - 1)^2 > 0.1^2 }
    exit bad }' "$scratch/load" - || complain "kart: its road load"

# Car on a road of 1.03 degrees, up north and down south, with 3.13 m/s of wind from the north; GPS
# speeds once a second in rows of some 45 Hz. The owners fit v' = -+g sin(theta) - mu g cos(theta) -
# rho Cd A u^2/2m, u the speed in the air: D = d0 + d2 u^2 with R = 1 and K = 0, mu = d0, Cd = 2 m g
# cos(theta) d2/(rho A), if u is the column of speeds. Each held reading taken as one more, as
# theirs are (but for the first, whose beginning nobody saw), their own mu, Cd and rms come back; of
# the readings alone the rms is less.
road=$data/car-coasting-lab
if [ -r "$road/north_data.csv" ]; then
  readings() {  # FILE WIND
    awk -F, -v wind="$2" -v OFS='\t' '
      /^[0-9]/ { if (v != "" && $2 != v) print $1, $2 + wind; v = $2 }' "$road/$1_data.csv"
  }
  held() {
    awk -v OFS='\t' '{ for (; v && t < $1 - 0.01; t += 0.0225) print t, v; t = $1; v = $2 }' "$1"
  }
  # The row of D = d0 + d2 u^2: mu Cd rms; the rms, of v(t) = k tan(phi0 - sqrt(p q) t)
  # for v' = -p - q v^2, k = sqrt(p/q), at the best v0.
  quadratic() {  # NAME SLOPE
    row "$scratch/$1.row" | cut -f 1,3 | awk -v S="$2" '
      function v(v0, t) { t = atan2(v0 / k, 1) - sqrt(p * q) * t; return k * sin(t) / cos(t) }
      function rss(v0,  i, sum) {
        for (i = 1; i <= n; i++) sum += (u[i] - v(v0, t[i] - t[1]))^2
        return sum }
      NR == 1 { d0 = $1; d2 = $2; next }
      { t[++n] = $1; u[n] = $2 }
      END {
        theta = atan2(S, 1); g = 9.81; p = g * (d0 * cos(theta) + sin(theta));
        q = g * d2 * cos(theta); k = sqrt(p / q)
        low = u[1] - 1; high = u[1] + 1
        while (high - low > 1e-6) {
          third = (high - low) / 3
          if (rss(low + third) < rss(high - third)) high -= third; else low += third
        }
        print d0, 2 * 1910 * g * cos(theta) * d2 / (1.06 * 2.15), sqrt(rss(low) / n)
      }' - "$scratch/$1"
  }
  for way in "north 3.13 0.0179788 0.0079 0.348 0.136" "south -3.13 -0.0179788 0.0228 0.233 0.108"; do
    read -r name wind slope mu Cd rms <<<"$way"
    readings "$name" "$wind" >"$scratch/$name"
    held "$scratch/$name" >"$scratch/$name-held"
    for records in "$name" "$name-held"; do
      fitpower -q --law 'd0+d2*v^2' --route velocity -K 0 -R 1 --slope "$slope" \
        "$scratch/$records" >"$scratch/$records.row"
      quadratic "$records" "$slope"
    done | awk -v name="$name" -v mu="$mu" -v Cd="$Cd" -v rms="$rms" '
      { printf "car, %s: mu %.4f Cd %.3f rms %.3f m/s of %s; its owners: %s %s %s\n",
          name, $1, $2, $3, NR == 1 ? "the readings" : "all rows", mu, Cd, rms }
      { off = NR == 1 ? 0.02 : 0.01 }
      ($1 / mu - 1)^2 > off^2 || ($2 / Cd - 1)^2 > off^2 { bad = 1 }
      NR == 1 ? $3 > 0.9 * rms : ($3 / rms - 1)^2 > off^2 { bad = 1 }
      END { exit bad || NR != 2 }' || complain "car, $name: not what its owners found"
  done
else
  echo "car: no car-coasting-lab in REAL_DATA; see tests/recordings.md"
fi

# Flywheel: rpm and ms; R = g = 1, so D is the angular deceleration in rad/s^2. Every 50th record; a
# gap of 1.8 s.
awk 'NF == 9 {
    t = ($6 - 783072) / 1000
    if (n && t <= last) next
    last = t
    if (n++ % 50 == 0) print t, $4 * 0.1047197551 }' \
  "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt" >"$scratch/wheel"
fit wheel --route velocity -K 0 -R 1 -g 1 --min-speed 1 "$scratch/wheel"
# Column 8 is the owners' own kinetic energy, of 0.8489 kg m^2: the law tells it at any time.
row "$scratch/wheel.row" | { read -r a _ b _ _ _ _ v0 _; awk -v a="$a" -v b="$b" -v v0="$v0" '
  NF == 9 && ++n % 2000 == 1 && n < 9000 {
    t = ($6 - 783072) / 1000
    w = (v0^(1 - b) - (1 - b) * a * t)^(1 / (1 - b)); E = 0.5 * 0.8489 * w^2
    printf "wheel: %.0f s, energy by the law %.1f J, recorded %.1f J\n", t, E, $8;
    far += (E / $8 - 1)^2 > 0.02^2; seen++ }
  END { exit far || seen < 4 }' "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt"; } ||
    complain "wheel: the energy"
# Down to the stop it is no power law: dry friction in the bearings holds the wheel to the end,
# where a v^b fades away. The law stops late; over the last 16 s the record slows down much more
# than the law has it; dry friction beside a power law is the best one.
fit whole --route velocity -K 0 -R 1 -g 1 "$scratch/wheel"
grep -q 'D = d0 + a v^b: .*AICc 0.0 above' "$scratch/whole.report" &&
  grep -q 'another law is better than' "$scratch/whole.report" ||
  complain "wheel: down to its stop a power law is said to be adequate"
row "$scratch/whole.row" | { read -r a _ b _ _ _ _ v0 _; awk -v a="$a" -v b="$b" -v v0="$v0" '
  $2 > 0 { stop = $1 } $1 > 241 && !slow { slow = $1; w = $2 }
  END { law = v0^(1 - b) / ((1 - b) * a); last = w / (stop - slow); at_half = a * (w / 2)^b
    printf "wheel: stop at %.0f s, by the law at %.0f s; ", stop, law
    printf "the last %.0f s slow down by %.3f rad/s^2, by the law %.3f\n", stop - slow, last, at_half
    exit !(law > stop + 5 && last > 1.2 * at_half) }' "$scratch/wheel"; } ||
      complain "wheel: the law stops on time"

# Small car: 500 Hz, rpm of a wheel of 0.5842 m, from the top of the spin-up. Its brake grows as it
# slows: no power law.
awk -F '\t' 'NR > 1 && $1 >= 9.6 && ++n % 10 == 1 { print $1, $8 / 60 * 3.14159265 * 0.5842 }' \
  "$data/small-car-coastdown/RR-Coastdown-1.txt" >"$scratch/car"
fit car --route velocity -K 0 -R 0.2921 "$scratch/car"
grep -q 'another law is better than' "$scratch/car.report" ||
  complain "car: a law is said to be adequate that is not"
awk '
  { t = $1; v = $2 }
  v > 10 { fast = t }
  v > 4 { mid = t }
  v > 1 { slow = t }
  END { exit !(6 / (mid - fast) < 3 / (slow - mid)) }' "$scratch/car" ||
  complain "car: it does not brake harder when it is slow"

# Sphere on wet grains: positions of a camera, scale and rate unverified. It flies at 0.7 m/s until
# it meets the grains at 0.18 s, so the whole record is no roll and is refused. From 0.2 s on it is
# one, known to a pixel (0.3 mm): b = 0.20 +- 0.06, not a constant D, but one linear in v does as
# well. The positions before 0.34 s tell to 2 mm in 32 where it lies still after 0.37 s.
awk -F , 'NR > 1 && $2 > 0 {
    if (!n++) { x = $2; y = $3 }
    print $1 / 250, sqrt(($2 - x)^2 + ($3 - y)^2) * 0.000307 }' \
  "$data/sphere-on-wet-grains/detections.csv" >"$scratch/sphere"
if fitpower -q --route position -K 0.4 -R 0.0075 "$scratch/sphere" 2>"$scratch/refusal"; then
  complain "sphere: the flight is taken for a roll"
fi
grep -q 'do not determine b' "$scratch/refusal" || complain "sphere: $(cat "$scratch/refusal")"
awk '$1 >= 0.2' "$scratch/sphere" >"$scratch/roll"
fit sphere --route position -K 0.4 -R 0.0075 "$scratch/roll"
row "$scratch/sphere.row" |
  awk '{ exit !($4 > 0.04 && $3 > 2 * $4 && $6 < 0.000307 && $7 == 43) }' ||
    complain "sphere: b, or the roll is not known to a pixel"
grep -q 'D = d0: .*AICc 8.[01] above' "$scratch/sphere.report" &&
  grep -q 'D = d0 + d1 v: .*AICc 0.0 above' "$scratch/sphere.report" &&
  grep -q 'no law that was tried is better than' "$scratch/sphere.report" ||
  complain "sphere: the laws"
awk '$1 < 0.34' "$scratch/roll" | fitpower -q --route position -K 0.4 -R 0.0075 >"$scratch/early"
simulate --law "$scratch/early" -K 0.4 -R 0.0075 --dt 0.01 --columns t,x | tail -n 1 |
  { read -r stop place; awk -v stop="$stop" -v place="$place" '
  $1 > 0.37 { rest += $2; n++ }
  END {
    printf "sphere: stops at %.3f s, x = %.1f mm; recorded %.1f mm\n", stop, 1e3 * place, 1e3 * rest / n
    exit !(n == 10 && (rest / n - place)^2 < 4e-6) }' "$scratch/roll"; } ||
  complain "sphere: it comes to rest elsewhere"
exit $wrong
