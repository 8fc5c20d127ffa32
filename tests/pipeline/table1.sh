#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Table 1 comes back from the raw runs; and the script can fail: with another paper value it
# does.
set -u
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
samples/table1.sh >"$scratch/out" || { cat "$scratch/out"; echo "samples/table1.sh fails"; exit 1; }
[ "$(grep -cE '^  (D\(v\)|trajectory).* \+- .* \+- .* \+- .* \+- ' "$scratch/out")" = 6 ] ||
  { cat "$scratch/out"; echo "not six fits with two errors each"; exit 1; }
# K moves a by dK/(1 + K), R by dR/R: by one body alone.
awk '/^rubber mat, (shell|cylinder)/ { K = /shell/ ? 0.83 : 0.5 } /^felt mat/ { exit }
  K && / x\(t\) / { given = $3 * sqrt((0.0029 / (1 + K))^2 + (0.000029 / 0.04)^2);
    if (($7 - given)^2 > 1e-8) exit 1; seen++ }
  END { exit seen != 2 }' "$scratch/out" ||
    { cat "$scratch/out"; echo "what K and R bring to a"; exit 1; }
cp samples/*.csv samples/*.toml samples/table1.sh samples/script.sh "$scratch"
sed -i 's/1\.87e-3/2.30e-3/' "$scratch/table1.sh"
if "$scratch/table1.sh" >"$scratch/out"; then
  cat "$scratch/out"; echo "a wrong a is not noticed"; exit 1
fi
cp samples/table1.sh "$scratch"
sed -i 's/a "\$a" -b/a "$(awk "BEGIN { print 1.1 * $a }")" -b/' "$scratch/table1.sh"
cmp -s samples/table1.sh "$scratch/table1.sh" && { echo "nothing was changed"; exit 1; }
if "$scratch/table1.sh" >"$scratch/out" 2>&1; then cat "$scratch/out";
  echo "an open balance is not noticed"; exit 1; fi
# A wrong K of the shell cancels in the shell's own balance; the ledger of the cylinder shows it.
cp samples/table1.sh "$scratch"
sed -i 's/0\.83/0.95/' "$scratch/SF.toml"
cmp -s samples/SF.toml "$scratch/SF.toml" && { echo "nothing was changed"; exit 1; }
if "$scratch/table1.sh" >"$scratch/out" 2>&1; then cat "$scratch/out";
  echo "a wrong K is not noticed"; exit 1; fi
grep -q '^  CF *SF .*TOO FAR' "$scratch/out" ||
  { cat "$scratch/out"; echo "K is not what is noticed"; exit 1; }
# Another slope for the roll down than for the roll up is none of one mat.
cp samples/SF.toml "$scratch"
sed 's/--slope -\$slope/--slope -0.0012/' samples/table1.sh >"$scratch/table1.sh"
cmp -s samples/table1.sh "$scratch/table1.sh" && { echo "nothing was changed"; exit 1; }
if "$scratch/table1.sh" >"$scratch/out" 2>&1; then cat "$scratch/out";
  echo "a wrong slope is not noticed"; exit 1; fi
grep -q '^  both, slope fitted.*TOO FAR' "$scratch/out" ||
  { cat "$scratch/out"; echo "the slope is not what is noticed"; exit 1; }
