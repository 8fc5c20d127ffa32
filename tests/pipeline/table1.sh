#!/bin/bash
# Table 1 comes back from the raw records; and the script can fail: with another paper value it does.
set -u
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
samples/table1.sh >"$scratch/out" || { cat "$scratch/out"; echo "samples/table1.sh fails"; exit 1; }
[ "$(grep -c '+- .*+- ' "$scratch/out")" = 6 ] || { cat "$scratch/out"; echo "not six fits"; exit 1; }
cp samples/*.csv samples/*.awk samples/table1.sh "$scratch"
sed -i 's/1\.87e-3/2.30e-3/' "$scratch/table1.sh"
if "$scratch/table1.sh" >"$scratch/out"; then cat "$scratch/out"; echo "a wrong a is not noticed"; exit 1; fi
cp samples/table1.sh "$scratch"
sed -i 's/a "\$a" -b/a "$(awk "BEGIN { print 1.1 * $a }")" -b/' "$scratch/table1.sh"
cmp -s samples/table1.sh "$scratch/table1.sh" && { echo "nothing was changed"; exit 1; }
if "$scratch/table1.sh" >"$scratch/out" 2>&1; then cat "$scratch/out"; echo "an open balance is not noticed"; exit 1; fi
# A wrong K of the shell cancels in the shell's own balance; the ledger of the cylinder shows it.
sed 's/^fits SF 0\.83 SF/fits SF 0.95 SF/; s/^fits F .*//' samples/table1.sh >"$scratch/table1.sh"
cmp -s samples/table1.sh "$scratch/table1.sh" && { echo "nothing was changed"; exit 1; }
if "$scratch/table1.sh" >"$scratch/out" 2>&1; then cat "$scratch/out"; echo "a wrong K is not noticed"; exit 1; fi
grep -q '^  CF *SF .*TOO FAR' "$scratch/out" || { cat "$scratch/out"; echo "K is not what is noticed"; exit 1; }
