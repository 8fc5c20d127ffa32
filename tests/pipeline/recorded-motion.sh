#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What eight recordings of others say about the motion in them, each against something that the
# reading did not use: a law of physics, a second sensor, a figure of the record's owners. What is
# measured is printed; each line must stay within its bounds.
set -u
export LC_ALL=C
unset CDPATH
data=${REAL_DATA:-}
[ -d "$data/cart-push-smartphone" ] ||
  { echo "skipped: REAL_DATA names no folder of recordings; see tests/recordings.md"; exit 77; }
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
wrong=0
# within NAME FIGURE LOW HIGH
within() {
  if awk -v x="$2" -v low="$3" -v high="$4" '
    BEGIN { exit !(x != "" && x + 0 >= low && x + 0 <= high) }'; then echo "$1: $2"
  else
    echo "$1: $2 is not between $3 and $4"
    wrong=1
  fi
}
numbers() { grep -v '^#' | grep .; }
mean() { numbers | awk -v k="$1" '{ s += $k; q += $k * $k }
  END { if (NR) print s / NR, sqrt(q / NR - (s / NR)^2) }'; }
# The running integral of column K by the trapezoidal rule, appended: a speed from an acceleration.
integrate() {
  awk -v k="$1" '!/^#/ && NF {
    if (n++) v += ($k + last) / 2 * ($1 - t)
    t = $1; last = $k
    print $0 "\t" v + 0 }'
}

# A cart with a phone on it: at rest, pushed, at rest again, uneven times. At rest the sensor is off
# by millimetres a second squared; shaken it is off by a hundred times more, so that the speed does
# not come back to 0. A straight line through the two rests takes that away, all but a tenth.
cart=$data/cart-push-smartphone/cart-pushFriction1.csv
along() { smooth -q -w 1 -c 'Linear Acceleration y' "$@" "$cart"; }
read -r bias scatter < <(along --from 3.25 --to 6.1 | mean 3)
within "cart: acceleration at rest [m/s^2]" "$bias" -0.01 0.01
within "cart: its scatter" "$scatter" 0.001 0.01
within "cart: speed gained in 2.85 s of rest [m/s]" \
  "$(along --from 3.25 --to 6.1 | integrate 3 | awk 'END { print $NF }')" -0.03 0
read -r left greatest least < <(along --from 0.45 --to 3.2 | integrate 3 |
  awk '{ t[NR] = $1; v[NR] = $NF }
  END {
    for (i = 1; i <= NR; i++) {
      u = v[i] - v[NR] * (t[i] - t[1]) / (t[NR] - t[1])
      if (u > most) most = u
      if (u < least) least = u
    }
    print v[NR], most, least
  }')
within "cart: speed after the stop, drift and all [m/s]" "$left" -1.4 -1.0
within "cart: greatest speed between the two rests" "$greatest" 0.8 1.1
within "cart: and the most backwards, which is none" "$least" -0.1 0

# A phone falls flat, then (another record) on its edge. Its offset along z, from the rest
# afterwards, where the three readings must make g, is that of the fall at speed 0; the drag grows
# as the square of the speed, and on edge there is none.
fall="$data/falling-phone/fall_2/Raw Data.csv"
phone() { smooth -q -w 1 -c 'Acceleration z' --from "$1" --to "$2" "$fall"; }
read -r ox oy < <(phone 3.05 3.3 | numbers |
  awk '{ x += $2; y += $3 } END { print x / NR, y / NR }')
offset=$(phone 4.8 5.9 | numbers | awk -v ox="$ox" -v oy="$oy" '{ x += $2; y += $3; z += $4 }
  END { print z / NR - sqrt(9.81^2 - (x / NR - ox)^2 - (y / NR - oy)^2) }')
within "phone: offset along z at rest [m/s^2]" "$offset" -0.12 0
phone 3.004 3.63 | awk -v o="$offset" '!/^#/ { print $1, 9.81 - ($4 - o), $4 - o }' | integrate 2 |
  awk '{ print $4, $3 }' >"$scratch"
drag() {  # LEAST-SPEED OPTION...: the row of the fit
  (echo '# v[m/s] D[m]'; awk -v least="$1" '$1 > least && $2 > 0' "$scratch") |
    fitpower -q --route loglog "${@:2}" | numbers
}
within "phone: speed at the end of the fall [m/s]" "$(awk 'END { print $1 }' "$scratch")" 5.6 5.9
within "phone: exponent of the drag" "$(drag 2 | cut -f 3)" 1.9 2.3
# Its owners begin their search at 13.
within "phone: terminal speed of a drag c v^2 [m/s]" \
  "$(drag 4 --fix b=2 | awk '{ print sqrt(9.81 / $1) }')" 12 15
within "phone: drag at speed 0 by a straight line in v^2 [m/s^2]" "$(awk '
  { x += $1^2; y += $2; xx += $1^4; xy += $1^2 * $2 }
  END { print (y - (xy - x * y / NR) / (xx - x * x / NR) * x) / NR }' "$scratch")" -0.1 0.1
edge() { smooth -q -w 1 -c 3 --from "$1" --to "$2" "$data/falling-phone/fall_vertical_1.txt" |
  mean 3 | cut -d ' ' -f 1; }
within "phone on edge: what 0.4 s of fall add along it [m/s^2]" "$(awk -v a="$(edge 3.2 3.25)" -v b="$(edge 3.6 3.65)" 'BEGIN { print a - b }')" -0.05 0.05

# A small car: wheel speed, a force on one wheel and an accelerometer, spin-up and coast. The
# accelerometer (in g, tilted) follows the slope of the wheel speed; one of the two driven wheels
# carries a little less than half of what moves 250 kg.
half_seconds() {
  awk -F '\t' -v OFS='\t' 'NR == 1 { print "t[s]", "v[m/s]", "Fx", "Ax"; next }
    { print $1, $8 / 60 * 3.14159265358979 * 0.5842, $2, 9.81 * $10 }' "$data/small-car-coastdown/RR-Coastdown-1.txt" |
    differentiate -q -M savgol -w 401 |
    awk '!/^#/ && $1 > 4.5 && $1 < 17 {
        i = int(2 * $1); n[i]++; a[i] += $5; F[i] += $3; A[i] += $4 }
      END { for (i in n) print a[i] / n[i], F[i] / n[i], A[i] / n[i] }'
}
line() {  # X Y: slope and correlation
  awk -v x="$1" -v y="$2" '{ sx += $x; sy += $y; xx += $x^2; xy += $x * $y; yy += $y^2 }
    END { xx -= sx^2 / NR; yy -= sy^2 / NR; xy -= sx * sy / NR; print xy / xx, xy / sqrt(xx * yy) }'
}
read -r slope fit < <(half_seconds | line 1 3)
within "small car: accelerometer against the slope of the speed" "$slope" -1.05 -0.95
within "small car: their correlation" "$fit" -1 -0.98
read -r share fit < <(half_seconds | line 1 2)
within "small car: share of one wheel in the force on 250 kg" \
  "$(awk -v s="$share" 'BEGIN { print -s / 250 }')" 0.40 0.50
within "small car: their correlation" "$fit" -1 -0.95

# A ball on a curved track: between two turns, where all energy is height, it passes the bottom,
# where some of it is speed. Slow enough not to slip, it has 1 + 2/5 of v^2/2. Each side's turns are
# lower every time, and at the last stop nothing moves.
track=$data/ball-on-curved-track/P1100902-data.csv
ball() { differentiate -q -c x -M savgol -w 9 "$track" | differentiate -q -c y -M savgol -w 9; }
read -r inertia error passes up turns < <(ball | awk '!/^#/ && $1 > 3.2 {  # t x y vx vy
    if (v * $4 < 0) {
      height[++turns] = $3
      up += turns > 2 && turns < 30 && $3 > height[turns - 2] + 1e-4
      if (turns > 1 && $1 > 9 && $1 < 20) {
        inertia = 9.81 * ((height[turns] + height[turns - 1]) / 2 - bottom) / (fast / 2)
        n++; s += inertia; q += inertia^2
      }
      fast = 0
    }
    if ($4^2 + $5^2 > fast) { fast = $4^2 + $5^2; bottom = $3 }
    v = $4
  }
  END { print s / n, sqrt((q / n - (s / n)^2) / n), n, up + 0, turns }')
within "ball: 1 + K of $passes passes, +- $error" "$inertia" 1.37 1.43
within "ball: turns, of the first 30, that are higher than the one before on their side" "$up" 0 0
within "ball: turns until it rests" "$turns" 60 80
within "ball: speed left in the last 0.2 s [m/s]" \
  "$(ball | awk '!/^#/ && $1 > 37.3 { n++; q += $4^2 } END { print sqrt(q / n) }')" 0 0.002
within "ball over a bumpy track: rows" "$(differentiate -c x "$data/ball-on-curved-track/mass_a.txt" | numbers | wc -l)" 132 132

# Coffee filters: the drag at the terminal speed is the weight. One filter and two: drag as v^2
# makes the squares 1 to 2.
filters() {  # RUN FROM TO: the speed, from the position by a line over nine samples
  smooth -q -c x -w 1 --outliers 4 --run "$1" "$data/falling-coffee-filters/data_for_coffee.csv" |
    differentiate -q -c x -M savgol -w 9 --order 1 |
    smooth -q -w 1 --from "$2" --to "$3" | mean 5 | cut -d ' ' -f 1
}
one=$(filters 12 2.2 2.42) two=$(filters 11 2.22 2.44)
within "coffee filters: terminal speed of one [m/s]" "$one" -0.95 -0.85
within "coffee filters: ratio of the squares, two to one" \
  "$(awk -v a="$one" -v b="$two" 'BEGIN { print (b / a)^2 }')" 1.85 2.15

# A drum: what it ran by its speed is what it turned, by 4.79 m a turn.
within "drum: way by speed / way by turns" "$(awk -F, '
  { t = $1 / 1e6 }
  NR == 1 { first = $3 }
  NR > 1 { x += (t - last) * (v + $2) / 7.2 }
  { last = t; v = $2 }
  END { print x / (($3 - first) * 4.79) }' "$data/wheel-on-drum/60psi- 215lbm- Left.csv")" 0.99 1.01

# A sphere on wet grains, marks in pixels: it rests in the last ten, and the roll that is kept ends
# when it has nearly come there.
marks() {
  awk -F, 'NR == 1 { print "# t[s] x" }
    NR > 1 && $4 > 0 {
      if (!n++) { x = $2; y = $3 }
      print $1 / 250, sqrt(($2 - x)^2 + ($3 - y)^2) }' \
    "$data/sphere-on-wet-grains/detections.csv"
}
within "sphere: scatter of the last ten marks [pixels]" \
  "$(marks | tail -n 10 | mean 2 | cut -d ' ' -f 2)" 0.3 1.5
within "sphere: last frame of its roll" \
  "$(marks | smooth -q --coast -c x -w 1 | awk 'END { print 250 * $1 }')" 70 96
exit $wrong
