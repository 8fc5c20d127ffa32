#!/bin/bash
# A coast-down that others recorded (a kart, km/h once a second, no time): the routes agree within their errors, and the
# balance closes when D is the measured one.
set -eu
file=${REAL_DATA:-}/kart-coastdown-1hz/Michelin60A.csv
[ -r "$file" ] || { echo "skipped: REAL_DATA has no kart-coastdown-1hz"; exit 77; }
record() { awk '{ print NR - 1, $1 / 3.6 }' "$file"; }
shifts() { record | smooth | differentiate | shift-from-accel -K 0 -R 0.15; }
[ "$(shifts | grep -vc '^#')" = 165 ]
{ shifts | fitpower -q; record | fitpower -q --route velocity -K 0 -R 0.15; } |
  awk '!/^#/ { b[++n] = $3; s[n] = $4 }
    END { d = b[1] - b[2]; if (n != 2 || d * d > 9 * (s[1]^2 + s[2]^2)) { print "b =", b[1], "and", b[2]; exit 1 } }'
shifts | energy-ledger -m 76 -K 0 -R 0.15 --summary --check 0.01 >/dev/null
