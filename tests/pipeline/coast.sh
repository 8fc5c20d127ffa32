#!/bin/bash
# smooth --coast finds the free roll of the samples and of other seeds, in positions and in speeds: it begins after the
# release at 1.5 s and two records more, and before 2.1 s; it ends within 0.5 s of the stop (the closed form's times).
set -eu
check() {  # NAME STOP FILE COLUMN
  smooth -q --coast -c "$4" -w 1 "$3" | awk -v name="$1 $4" -v stop="$2" '!/^#/ { if (!n++) first = $1; last = $1 }
    END { if (first < 1.58 || first > 2.1 || last > stop + 0.04 || last < stop - 0.5) { print name ": from " first " to " last ", stop " stop; exit 1 } }'
}
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
for scene in CF CR SF SR; do
  stop=$(simulate --scene "samples/$scene.toml" --dt 0.5 | awk 'END { print $1 + 1.5 }')
  for column in x v; do
    check "$scene" "$stop" "samples/$scene.csv" "$column"
  done
  for seed in 11 12 13 14 15 16 17 18 19 20; do
    simulate --scene "samples/$scene.toml" --sensor pasco --seed "$seed" >"$scratch"
    for column in x v; do check "$scene seed $seed" "$stop" "$scratch" "$column"; done
  done
done
# A fit of what is kept is right within 4 standard errors.
smooth -q --coast -c x -w 1 "$scratch" | fitpower -q --route position -K 0.83 -R 0.04 |
  awk '!/^#/ { if (($1 - 1.78e-3)^2 > 16 * $2^2 || ($3 - 0.255)^2 > 16 * $4^2) { print; exit 1 } }'
