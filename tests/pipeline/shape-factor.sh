#!/bin/bash
# The shape factor comes back from made records with the error that is told, over 25 seeds of two
# bodies; a caliper that is read wrong is noticed; and what is printed serves as -K.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
samples/shape-factor.sh >"$scratch/out" || { echo "samples/shape-factor.sh fails"; exit 1; }
[ "$(grep -cE '^(cylinder|shell): K = 0\.[0-9]{4}\+-0\.00[0-9]{2} \(made with' "$scratch/out")" = 2 ] &&
  [ "$(grep -cE '^0\.001' "$scratch/out")" = 2 ] || { cat "$scratch/out"; exit 1; }

# The pulls, (K - true) / sigma, of the script $1.
pulls() {
  local seed body
  for seed in $(seq 25); do
    "$1" make "$scratch" "$seed"
    for body in cylinder:0.50 shell:0.83; do
      echo "$("$1" "$scratch/${body%:*}-fall.csv" "$scratch/${body%:*}-spin.csv")" "${body#*:}"
    done
  done | sed 's/+-/ /' | awk '{ print ($1 - $3) / $2 }'
}
pulls samples/shape-factor.sh >"$scratch/pulls"
# The sum of 50 squares lies between 28 and 79 in 99 % of all cases, the mean within 0.36.
awk '{ sum += $1; squares += $1^2 }
  END { print NR, sum / NR, squares; exit !(NR == 50 && squares > 28 && squares < 79 && (sum / NR)^2 < 0.13) }' \
  "$scratch/pulls" >"$scratch/said" || { echo "pulls: $(cat "$scratch/said")"; exit 1; }

# A torque that is 2 % wrong; the records are made with the right one.
cp samples/CR.csv samples/SR.csv "$scratch"
sed '/^acceleration/,/^make_records/ s/w \* (g - r \* alpha) \* r/w * (g - r * alpha) * 1.02 * r/' \
  samples/shape-factor.sh >"$scratch/wrong.sh"
cmp -s samples/shape-factor.sh "$scratch/wrong.sh" && { echo "nothing was changed"; exit 1; }
chmod +x "$scratch/wrong.sh"
pulls "$scratch/wrong.sh" | awk '{ squares += $1^2 } END { exit !(squares > 200) }' ||
  { echo "a radius that is wrong is not noticed"; exit 1; }
