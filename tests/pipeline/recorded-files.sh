#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Files that motion programs and other people wrote, read as they are or after one line of sed or
# awk: records, runs, and what can be checked in each.
set -u
export LC_ALL=C
unset CDPATH
data=${REAL_DATA:-}
[ -d "$data/cart-vernier" ] ||
  { echo "skipped: REAL_DATA names no folder of recordings; see tests/recordings.md"; exit 77; }
failed=0

# expect FIGURES COMMAND...: the records of each run that the command prints
expect() {
  local want=$1 got
  shift
  got=$("$@" 2>/dev/null |
    awk '/^#/ { next } NF == 0 { if (n) printf "%d ", n; n = 0; next } { n++ } END { print n + 0 }')
  [ "$got" = "$want" ] || { echo "$*: $got records instead of $want"; failed=1; }
}
refuse() {  # MESSAGE-END COMMAND...
  local want=$1 got
  shift
  if got=$("$@" 2>&1 >/dev/null); then echo "$*: not refused"; failed=1; fi
  case $got in *"$want") ;; *) echo "$*: $got"; failed=1 ;; esac
}
names() { "$@" 2>/dev/null | grep '^# ' | tail -n 1; }
named() {  # NAMES COMMAND...
  local want got
  want=$(printf '# %b' "$1")
  shift
  got=$(names "$@")
  [ "$got" = "$want" ] || { echo "$*: names $got"; failed=1; }
}

# Capstone: ten runs side by side, quoted names, BOM; a velocity is missing at both ends of each
# run.
coffee=$data/falling-coffee-filters/data_for_coffee.csv
expect "265 349 287 253 158 114 139 123 145 172" smooth -w 1 "$coffee"
expect "267 351 289 255 160 116 141 125 147 174" smooth -w 1 -c x "$coffee"
expect 172 smooth -w 1 --run 12 "$coffee"
refuse "there is no run 7 (runs: 2, 3, 4, 5, 6, 8, 9, 10, 11, 12)" smooth --run 7 "$coffee"
named 't[s]\tx[m]\tv[m/s]\ta[m/s^2]' smooth "$coffee"

# Vernier: names with a data set before them and the unit glued on.
vernier="$data/cart-vernier/Project oefenbestand 1.csv"
expect 304 differentiate "$vernier"
named 't[s]\tx[m]\tv[m/s]\ta_in[m/s^2]\ta[m/s^2]' differentiate "$vernier"

# phyphox, saved again and as it comes: an acceleration named by hand.
expect 621 shift-from-accel --use 'a=Linear Acceleration y' -K 0 -R 1 "$data/cart-push-smartphone/cart-pushFriction1.csv"
named 't[s]\tLinear_Acceleration_x[m/s^2]\tLinear_Acceleration_y[m/s^2]\tLinear_Acceleration_z[m/s^2]\tAbsolute_acceleration[m/s^2]' \
  smooth -c 'Linear Acceleration y' "$data/cart-push-smartphone/cart-pushFriction1.csv"
expect 1520 smooth -c 'Acceleration y' "$data/falling-phone/fall_2/Raw Data.csv"
named 't[s]\tAcceleration_x[m/s^2]\tAcceleration_y[m/s^2]\tAcceleration_z[m/s^2]\tAbsolute_acceleration[m/s^2]' \
  smooth -c 'Acceleration y' "$data/falling-phone/fall_2/Raw Data.csv"
expect 2237 smooth -c 3 "$data/falling-phone/fall_vertical_1.txt"
expect 132 smooth -c x "$data/ball-on-curved-track/mass_a.txt"
named 't[s]\tx[m]\ty' smooth "$data/ball-on-curved-track/mass_a.txt"

# Tracker: the track's name above the names line; semicolons, tabs.
expect 3752 differentiate -c x "$data/ball-on-curved-track/P1100902-data.csv"
# Tracker with decimal commas between commas has two readings; by its six decimals it has one, the
# authors' own.
pucks=$data/air-table-pucks/ResultatKollisjon1.txt
refuse "10 fields under a line of 6 names: begin that with # if it is no header, put quotes around names that hold a separator, and make decimal commas points" smooth "$pucks"
[ "$(sed -E 's/([0-9]),([0-9]{6}E)/\1.\2/g; s/−/-/g' "$pucks" | smooth -q -w 1 --use t=1 --use v=2 |
  awk '!/^#/ { print $1 + 0, $2 + 0, $3 + 0 }' | md5sum)" = \
  "$(awk -F ';' '{ print $1 + 0, $2 + 0, $3 + 0 }' "${pucks%.txt}.csv" | md5sum)" ] ||
    { echo "$pucks: not the authors' numbers"; failed=1; }

# Columns without names: km/h once a second; microseconds; milliseconds and rpm behind a line that
# is cut off.
kart() { awk '{ print NR - 1, $1 / 3.6 }' "$data/kart-coastdown-1hz/Michelin60$1.csv" |
  energy-ledger -m 76 -K 0 -R 0.15 -a 1e-3 -b 0; }
expect 165 kart A
expect 231 kart B
distance() {
  awk '{ s += $1 / 3.6 } END { printf "%.0f", s }' "$data/kart-coastdown-1hz/Michelin60$1.csv"
}
[ "$(distance A) $(distance B)" = "642 733" ] || { echo "kart: distances"; failed=1; }
drum() { awk -F, '{ print $1 / 1e6, $2 / 3.6 }' "$data/wheel-on-drum/60psi- 215lbm- Left.csv" |
  smooth --seconds 1; }
expect 4508 drum
flywheel() {
  echo 't[ms] rpm E[J]'
  sed 1d "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt" |
    awk '{ print $6, $4, $8 }'
}
expect 12922 eval 'flywheel | smooth -c rpm'
# Its energy column is 1/2 J omega^2 with J = 0.8489 kg m^2 of the very rpm beside it.
flywheel | smooth -w 1 -c rpm |
  awk '!/^#/ { w = $2 * atan2(0, -1) / 30; e = 0.5 * 0.8489 * w * w;
      if ((e - $3)^2 > (1e-3 * $3 + 0.05)^2) bad++ }
  END { exit bad > 0 }' || { echo "flywheel: energy beside rpm"; failed=1; }
refuse "9 fields where the first row has 3" smooth "$data/flywheel-spindown/spindown_poweredOff_badSprocket.txt"
expect 9904 smooth -c 'RR_Wheel Speed' "$data/small-car-coastdown/RR-Coastdown-1.txt"
# Figures that its owners or its README give: the top of the spin-up, the top speed, the spacing of
# the phone's records.
check() { awk "$2" || { echo "$1"; false; }; }
smooth -w 1 -c 'RR_Wheel Speed' "$data/small-car-coastdown/RR-Coastdown-1.txt" |
  check "small car: not 431 rpm at 9.54 s" '
    !/^#/ && $8 > most { most = $8; at = $1 }
    END { exit !(int(most + 0.5) == 431 && at > 9.53 && at < 9.55) }' || failed=1
drum | check "drum: not about 95 km/h" '
  !/^#/ && 3.6 * $2 > most { most = 3.6 * $2 }
  END { exit !(most > 93 && most < 98) }' || failed=1
smooth -c 'Acceleration y' "$data/falling-phone/fall_2/Raw Data.csv" |
  check "phone: records not 5.00 to 5.07 ms apart" '
    !/^#/ { if (n++ && ($1 - last < 0.004995 || $1 - last > 0.005075)) bad++; last = $1 }
    END { exit !(n == 1520 && !bad) }' || failed=1

# Video marks: 0,0,0 is no position; the time comes from the frame.
marks() { awk -F, 'NR == 1 { print "t[s] x"; next }
  $4 > 0 { print $1 / 250, $2 }' "$data/sphere-on-wet-grains/detections.csv"; }
expect 82 eval 'marks | differentiate -c x'
exit $failed
