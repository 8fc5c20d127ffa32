#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Whatever table a tool writes, a tool and an independent reader (awk) find the same names, units,
# runs, history, comments and cells in it: random files of runs (all separators, names in every form,
# quotes, blank cells, comments in every place, units that change) through chains of tools.
# FILES sets how many files of 20 runs there are; 5000 of them are 100,000 round trips.
set -u
cd "$(dirname "$0")/round-trip" || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
export LC_ALL=C
FILES=${FILES:-60} runs=20 wrong=0

chains=('differentiate' 'differentiate | shift-from-accel -K 0.5 -R 0.04 -g 1e20' 'differentiate | differentiate -c a')
extra=('a[m/s^2]' 'a[m/s^2]|D[m]' 'a[m/s^2]|da[m/s^2/s]')
history=('differentiate v central'
  'differentiate v central|shift-from-accel K 0.5 R 0.04 g 1e+20'
  'differentiate v central|differentiate a central')
for seed in $(seq "$FILES"); do
  c=$((seed % ${#chains[@]}))
  awk -v seed="$seed" -v runs=$runs -v file="$scratch/in" -v expected="$scratch/expected" \
    -v extra="${extra[c]}" -v history="${history[c]}" -f make.awk
  if ! (set -o pipefail; eval "${chains[c]}") <"$scratch/in" >"$scratch/out" 2>"$scratch/err"; then
    echo "seed $seed, ${chains[c]}: $(cat "$scratch/err")"
    wrong=$((wrong + 1))
    continue
  fi
  columns=$(tr -cd '|' <<<"${extra[c]}" | wc -c)
  awk -v extra=$((columns + 1)) -f read.awk "$scratch/out" >"$scratch/found"
  # A name that the file does not give is the tools' own matter.
  grep -v '^RUN [0-9]*$' "$scratch/found" | diff "$scratch/expected" - >"$scratch/diff" && continue
  echo "seed $seed, ${chains[c]}:"
  head -n 6 "$scratch/diff"
  wrong=$((wrong + 1))
done
echo "$((FILES * runs)) round trips, $wrong files wrong"
[ "$wrong" = 0 ]
