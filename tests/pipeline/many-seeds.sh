#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Simulated runs of many seeds, through the whole chain: a and b come back within the errors that
# fitpower reports. Of 12 runs with honest 95 % intervals fewer than 9 hits have a chance of 1 in 450,
# of 40 runs (with LONG=1) fewer than 33 one of 1 in 700; two normal scores beyond 5, of 1 in a million.
set -eu
export LC_ALL=C
unset CDPATH
runs=12 least=9
[ -z "${LONG-}" ] || runs=40 least=33
run() { simulate --scene "samples/$1.toml" --memory 5e-4 --damping 0.02 --sensor pasco --seed "$2" | smooth -q --coast -c x -w 1; }
by_position() { run "$1" "$2" | fitpower -q --route position -K 0.5 -R 0.04; }
by_shift() { run "$1" "$2" | differentiate -c x | smooth -w 11 | differentiate |
  shift-from-accel -K 0.5 -R 0.04 | fitpower -q; }
for route in position shift; do
  for scene in "CF 5.75e-4 2.44e-2" "CR 1.87e-3 2.15e-1"; do
    read -r name a b <<<"$scene"
    for seed in $(seq 101 $((100 + runs))); do "by_$route" "$name" "$seed"; done |
      awk -v a="$a" -v b="$b" -v what="$name by $route" -v least=$least '!/^#/ {
        za = ($1 - a) / $2; zb = ($3 - b) / $4; hits_a += za^2 < 3.84; hits_b += zb^2 < 3.84;
        far += za^2 > 25 || zb^2 > 25 }
        END { if (hits_a < least || hits_b < least || far) {
            print what ": within 95 %:", hits_a, hits_b, "of '$runs'; beyond 5 sigma:", far + 0;
            exit 1 } }'
  done
done
