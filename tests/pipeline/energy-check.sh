#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the energy check catches, and what it cannot: a law that is right, one that is 5 % too large,
# and the five wrong inputs of energy-ledger(1), "What the check tests".
set -u
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
scene=samples/CR.toml
simulate --scene "$scene" --columns t,v >"$scratch/roll"

# check STATUS SAYS ARGUMENT...: the status of energy-ledger --check 1e-3 --summary, and what it says
# on standard error, a pattern. Its row is left in $row.
row=
check() {
  local status=$1 says=$2 said
  shift 2
  energy-ledger --check 1e-3 --summary "$@" >"$scratch/out" 2>"$scratch/err"
  local is=$?
  row=$(grep -v '^#' "$scratch/out")
  said=$(cat "$scratch/err")
  # shellcheck disable=SC2053  # a pattern
  [[ $is -eq $status && $said == $says ]] || {
    echo "energy-ledger $*: status $is, not $status, or it says: $said"
    exit 1
  }
}
# The closure and the imbalance in $row are in these bounds.
bounds() {
  awk -v c1="$1" -v c2="$2" -v i1="$3" -v i2="$4" \
    '{ exit !($4 >= c1 && $4 <= c2 && $5 >= i1 && $5 <= i2) }' <<<"$row" ||
    { echo "closure and imbalance are not in $*: $row"; exit 1; }
}

check 0 "" --scene "$scene" "$scratch/roll"
bounds -1e-5 1e-5 0 1e-5
check 1 "*check does not hold: closure 0.05, imbalance 0.05 at t = 2.41803 s, closure_p 0.04999, closure_L 0.04999: beyond 0.001" \
  --scene "$scene" -a 1.9635e-3 "$scratch/roll"
bounds 0.0499 0.0501 0.0499 0.0501

# 1. An exponent that is wrong, with the coefficient that dissipates all the energy at the end.
check 1 "*check does not hold: imbalance 0.0418? at t = 0.82 s, closure_p 0.1369, closure_L 0.1369: beyond 0.001" \
  --scene "$scene" -a 1.4378938594202331e-3 -b 0 "$scratch/roll"
bounds -1e-5 1e-5 0.04 0.05

# 2, 3. K, R or g wrong in the fit and in the ledger: they cancel, and the check cannot see it.
for wrong in "-K 0.6 -R 0.04 -g 9.81" "-K 0.5 -R 0.05 -g 9.81" "-K 0.5 -R 0.04 -g 9"; do
  # shellcheck disable=SC2086  # words
  fitpower -q --route velocity $wrong "$scratch/roll" >"$scratch/law"
  # shellcheck disable=SC2086
  check 0 "" -m 1.375 $wrong --law "$scratch/law" "$scratch/roll"
  bounds -1e-5 1e-5 0 1e-5
done

# 4. D differenced from the same v: the integral is the difference of the energies by construction,
# which energy-ledger says; not where a law stands in for that D.
differentiate "$scratch/roll" | shift-from-accel -K 0.5 -R 0.04 >"$scratch/D"
nothing="*D was computed from the derivative of the same v: the balance compares v with itself*"
check 0 "$nothing" -m 1.375 -K 0.5 -R 0.04 "$scratch/D"
awk '/^#/ { print; next } { $2 *= 1 + 0.2 * sin(5 * $1); print }' "$scratch/roll" |
  differentiate | shift-from-accel -K 0.5 -R 0.04 >"$scratch/any"
check 0 "$nothing" -m 1.375 -K 0.5 -R 0.04 "$scratch/any"  # another v, just as good
check 0 "" -q -m 1.375 -K 0.5 -R 0.04 "$scratch/D"
check 0 "" --scene "$scene" -a 1.87e-3 -b 0.215 "$scratch/D"

# 5. A slope that nobody told, 1 mm in a metre, under a constant shift. The law of a level mat finds
# it. A law that was fitted to the same run has taken the slope for shift, and nothing can tell.
awk 'BEGIN {
  S = 0.001; along = S / sqrt(1 + S^2); across = along / S
  a = 9.81 * (5.75e-4 * across + 0.04 * along) / (1.5 * 0.04)
  print "# t[s]\tv[m/s]"
  for (t = 0; t < 0.5 / a; t += 0.04) printf "%.17g\t%.17g\n", t, 0.5 - a * t
  printf "%.17g\t0\n", 0.5 / a }' >"$scratch/inclined"
check 1 "*check does not hold: closure -0.065*, imbalance 0.065* at t = 4.9* s, closure_p -0.065*, closure_L -0.065*: beyond 0.001" \
  -m 1.375 -K 0.5 -R 0.04 -a 5.75e-4 -b 0 "$scratch/inclined"
check 0 "" -m 1.375 -K 0.5 -R 0.04 -a 5.75e-4 -b 0 --slope 0.001 "$scratch/inclined"
bounds -1e-12 1e-12 0 1e-12
fitpower -q --route velocity -K 0.5 -R 0.04 "$scratch/inclined" >"$scratch/law"
check 0 "" -m 1.375 -K 0.5 -R 0.04 --law "$scratch/law" "$scratch/inclined"

# The same with a shift that depends on the speed, uphill and downhill on rubber.
# The momentum tells a large slope from a shift, the energy does not.
while read -r slope status says; do
  simulate --scene "$scene" --slope "$slope" --columns t,v >"$scratch/inclined"
  check 0 "" --scene "$scene" --slope "$slope" "$scratch/inclined"
  bounds -1e-6 1e-6 0 1e-6
  check 1 "*check does not hold: closure *" --scene "$scene" "$scratch/inclined"
  bounds -0.13 0.03 0.028 0.13
  fitpower -q --route velocity -K 0.5 -R 0.04 "$scratch/inclined" >"$scratch/law"
  check "$status" "$says" --scene "$scene" --law "$scratch/law" "$scratch/inclined"
  bounds -1e-3 1e-3 0 1e-3
done <<'END'
0.005 1 *does not hold: closure_p -0.0017*, closure_L -0.0017*
-0.001 0
END
# Where the fit knows the slope, its row hands it on.
printf 'a[m] b slope\n1.87e-3 0.215 -0.001\n' >"$scratch/law"
check 0 "" --scene "$scene" --law "$scratch/law" "$scratch/inclined"
check 1 "*" --scene "$scene" --law "$scratch/law" --slope 0 "$scratch/inclined"
