#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# smooth --coast finds the free roll of the samples and of other seeds, in positions and in speeds:
# it begins after the release at 1.5 s, and before 2.1 s; it ends at most 0.75 s before the stop and
# 0.04 s after it (the closed form's times). So it does, in positions, on worse runs: with noise
# of 0.1 to 3 mm, one echo in twenty lost, 20 or 50 rows a second, hardly any rest before and
# after (0.4 s), a roll backwards at the end; with noise of 3 mm it begins before 2.5 s. What comes
# without noise from simulate, and ends at the stop, loses three rows at most.
set -eu
within() {  # NAME FILE COLUMN EARLIEST LATEST-START EARLIEST-END LATEST
  smooth -q --coast -c "$3" -w 1 "$2" |
    awk -v name="$1 $3" -v a="$4" -v b="$5" -v c="$6" -v d="$7" '
    !/^#/ { if (!n++) first = $1; last = $1 }
    END { if (!n || first < a || first > b || last < c || last > d) {
        print name ": from " first " to " last ", not from " a ".." b " to " c ".." d; exit 1 } }'
}
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
stops() { simulate --scene "samples/$1.toml" --dt 0.5 | awk 'END { print $1 + 1.5 }'; }
after() { awk -v t="$1" -v dt="$2" 'BEGIN { print t + dt }'; }
check() { within "$1" "$2" "$3" 1.5 2.1 "$(after "$4" -0.75)" "$(after "$4" 0.04)"; }
for scene in CF CR SF SR; do
  stop=$(stops "$scene")
  for column in x v; do check "$scene" "samples/$scene.csv" "$column" "$stop"; done
  for seed in 11 12 13 14 15 16 17 18 19 20; do
    simulate --scene "samples/$scene.toml" --sensor pasco --seed "$seed" >"$scratch"
    for column in x v; do check "$scene seed $seed" "$scratch" "$column" "$stop"; done
  done
done
# A fit of what is kept is right within 4 standard errors.
smooth -q --coast -c x -w 1 "$scratch" | fitpower -q --route position -K 0.83 -R 0.04 |
  awk '!/^#/ { if (($1 - 1.78e-3)^2 > 16 * $2^2 || ($3 - 0.255)^2 > 16 * $4^2) { print; exit 1 } }'

for scene in CF CR SF SR; do
  simulate --scene "samples/$scene.toml" --dt 0.02 >"$scratch"
  rows=$(grep -vc '^#' "$scratch")
  for column in x v; do
    kept=$(smooth -q --coast -c "$column" "$scratch" | grep -vc '^#')
    ((kept + 3 >= rows)) || { echo "$scene $column without noise: $kept of $rows rows"; exit 1; }
  done
done

seed=100
for scene in CF CR SF SR; do
  stop=$(stops "$scene")
  for options in "--noise 1e-4" "--noise 1e-3" "--noise 3e-3" "--noise 1e-3 --lost 0.05" \
    "--lost 0.05 --rate 20" "--rate 50" "--memory 5e-4 --damping 0.02"; do
    seed=$((seed + 1))
    # shellcheck disable=SC2086  # options are words
    simulate --scene "samples/$scene.toml" --sensor pasco --seed "$seed" $options |
      awk -F, -v stop="$stop" 'NR == 1 || ($1 > 0.8 && $1 < stop + 0.4)' >"$scratch"
    latest=2.1
    [ "$options" = "--noise 3e-3" ] && latest=2.5
    within "$scene seed $seed $options" "$scratch" x 1.5 "$latest" "$(after "$stop" -0.75)" "$stop"
  done
done
