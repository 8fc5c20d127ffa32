#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The coast-down times of a regulation: 40 CFR 86.529-98, Figure F98-9, has for motorcycles of an
# equivalent inertial mass the load F = A + C v^2 and the time from 70 to 60 km/h. simulate gives
# them within 0.3 %, which is what the digits of C and of the times leave, but for the row of 160 kg:
# its 4.10 s lie outside of the middle of its own limits, to which 4.18 s belong, as to the rows
# beside it. It is very likely a misprint.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
PATH="$PWD/bin:$PATH"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
rows=0 wrong=0
complain() { echo "$*" && wrong=1; }
while read -r mass A C time longest shortest; do
  rows=$((rows + 1))
  awk -v m="$mass" -v A="$A" -v C="$C" 'BEGIN { weight = m * 9.81
    printf "d0[m] d2[s^2/m]\n%.17g %.17g\n", A / weight, C * 12.96 / weight }' >"$scratch/law"
  # The mass counts what turns: K = 0. With R = 1, D is F over the weight.
  took=$(simulate --law "$scratch/law" -K 0 -R 1 --v0 19.444444444444443 --until 12 --dt 0.01 --columns t,v | awk '
    /^#/ { next }
    3.6 * $2 <= 60 { print t + ($1 - t) * (3.6 * v - 60) / (3.6 * (v - $2)); exit }
    { t = $1; v = $2 }')
  awk -v mass="$mass" -v took="$took" -v time="$time" -v longest="$longest" -v shortest="$shortest" 'BEGIN {
    off = took / time - 1
    if (mass == 160) exit !(off > 0.015 && off < 0.02 && (took - (longest + shortest) / 2)^2 < 0.03^2)
    exit !(off^2 < 0.003^2 && took < longest && took > shortest) }' ||
    complain "$mass kg: $took s, and the regulation has $time s"
done <<'END'
100 0.0 .0224 2.95 3.1 2.8
110 0.82 .0227 3.18 3.3 3.0
120 1.70 .0230 3.39 3.6 3.2
130 2.57 .0233 3.60 3.8 3.4
140 3.44 .0235 3.80 4.0 3.6
150 4.32 .0238 3.99 4.2 3.8
160 5.19 .0241 4.10 4.4 4.0
170 6.06 .0244 4.36 4.6 4.2
180 6.94 .0246 4.53 4.7 4.3
190 7.81 .0249 4.69 4.9 4.5
200 8.69 .0252 4.85 5.1 4.6
210 9.56 .0255 5.00 5.2 4.8
220 10.43 .0257 5.15 5.4 4.9
230 11.31 .0260 5.30 5.5 5.1
240 12.18 .0263 5.43 5.7 5.2
250 13.06 .0266 5.57 5.8 5.4
260 13.93 .0268 5.70 5.9 5.5
270 14.80 .0271 5.82 6.1 5.6
280 15.68 .0274 5.95 6.2 5.7
290 16.55 .0277 6.06 6.3 5.8
300 17.43 .0279 6.18 6.4 6.0
310 18.30 .0282 6.29 6.5 6.1
320 19.17 .0285 6.40 6.6 6.2
330 20.05 .0288 6.50 6.7 6.3
340 20.92 .0290 6.60 6.8 6.4
END
[ $rows = 25 ] || complain "$rows rows"
exit $wrong
