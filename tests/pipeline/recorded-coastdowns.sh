#!/bin/bash
# Four coast-downs that others recorded: which law is adequate, with what errors. What is checked does not come from the fit that it
# checks: another route, a figure of the record's owners, or the reckoning of the way.
set -eu
data=${REAL_DATA:-}
[ -r "$data/kart-coastdown-1hz/Michelin60A.csv" ] || { echo "skipped: REAL_DATA is not set, or has no kart-coastdown-1hz"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*"; wrong=1; }
row() { grep -v '^#' "$1"; }
fit() { local name=$1; shift; fitpower -q --report "$@" >"$scratch/$name.row" 2>"$scratch/$name.report"; echo "$name: $(cut -f1-4 "$scratch/$name.row" | tail -n 1)"; tail -n 1 "$scratch/$name.report"; }

# Kart, km/h once a second, two directions in one fit; the route through D agrees with the trajectory, and the balance closes
# when D is the measured one.
kart() { awk '{ print NR - 1, $1 / 3.6 }' "$data/kart-coastdown-1hz/Michelin60$1.csv"; }
shifts() { kart "$1" | smooth -w 11 | differentiate | shift-from-accel -K 0 -R 0.15; }
{ kart A; echo; kart B; } >"$scratch/kart"
fit kart --route velocity -K 0 -R 0.15 "$scratch/kart"
{ shifts A | fitpower -q; kart A | fitpower -q --route velocity -K 0 -R 0.15; } |
  awk '!/^#/ { b[++n] = $3; s[n] = $4 } END { d = b[1] - b[2]; exit !(n == 2 && d * d < 9 * (s[1]^2 + s[2]^2)) }' || complain "kart: the routes do not agree"
for way in A B; do shifts $way | energy-ledger -m 76 -K 0 -R 0.15 --summary --check 0.01 >/dev/null || complain "kart $way: the balance does not close"; done
grep -q 'v^b is adequate' "$scratch/kart.report" || complain "kart: the law of the trajectory is not adequate"

# Flywheel: rpm and ms; R = g = 1, so D is the angular deceleration in rad/s^2. Every 50th record; a gap of 1.8 s.
awk 'NF == 9 { t = ($6 - 783072) / 1000; if (n && t <= last) next; last = t; if (n++ % 50 == 0) print t, $4 * 0.1047197551 }' \
  "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt" >"$scratch/wheel"
fit wheel --route velocity -K 0 -R 1 -g 1 --min-speed 1 "$scratch/wheel"
# Column 8 is the owners' own kinetic energy, of 0.8489 kg m^2: the law tells it at any time.
row "$scratch/wheel.row" | { read -r a _ b _ _ _ _ v0 _; awk -v a="$a" -v b="$b" -v v0="$v0" '
  NF == 9 && ++n % 2000 == 1 && n < 9000 { t = ($6 - 783072) / 1000; w = (v0^(1 - b) - (1 - b) * a * t)^(1 / (1 - b)); E = 0.5 * 0.8489 * w^2
    printf "wheel: %.0f s, energy by the law %.1f J, recorded %.1f J\n", t, E, $8; far += (E / $8 - 1)^2 > 0.02^2; seen++ }
  END { exit far || seen < 4 }' "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt"; } || complain "wheel: the energy"
grep -q 'v^b is adequate' "$scratch/wheel.report" || complain "wheel: the law is not adequate"

# Small car: 500 Hz, rpm of a wheel of 0.5842 m, from the top of the spin-up. Its brake grows as it slows: no power law.
awk -F '\t' 'NR > 1 && $1 >= 9.6 && ++n % 10 == 1 { print $1, $8 / 60 * 3.14159265 * 0.5842 }' "$data/small-car-coastdown/RR-Coastdown-1.txt" >"$scratch/car"
fit car --route velocity -K 0 -R 0.2921 "$scratch/car"
grep -q 'v^b is not adequate' "$scratch/car.report" || complain "car: a law is said to be adequate that is not"
awk '{ t = $1; v = $2; if (v > 10 && !high) high = t; if (v > 10) fast = t; if (v > 4) mid = t; if (v > 1) slow = t } END { exit !(6 / (mid - fast) < 3 / (slow - mid)) }' "$scratch/car" ||
  complain "car: it does not brake harder when it is slow"

# Sphere on wet grains: 82 positions, scale and rate unverified; b is not known to better than about 1.
awk -F , 'NR > 1 && $2 > 0 { if (!n++) { x = $2; y = $3 } print $1 / 250, sqrt(($2 - x)^2 + ($3 - y)^2) * 0.000307 }' "$data/sphere-on-wet-grains/detections.csv" >"$scratch/sphere"
fit sphere --route position -K 0.4 -R 0.0075 "$scratch/sphere"
row "$scratch/sphere.row" | awk '{ exit !($4 > 0.2 && $7 == 82) }' || complain "sphere: b is given as better known than it is"
exit $wrong
