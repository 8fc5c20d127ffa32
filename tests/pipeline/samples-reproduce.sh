#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make samples` makes the raw runs again byte for byte.
set -eu
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
make -n samples | grep '^bin/simulate' >"$scratch/recipe"
[ "$(wc -l <"$scratch/recipe")" = 4 ] || { echo "not four recipes"; exit 1; }
sed "s#>samples/#>$scratch/#" "$scratch/recipe" | bash -eu
for name in CF CR SF SR; do cmp "samples/$name.csv" "$scratch/$name.csv"; done
samples/exports/make.sh "$scratch"
for name in capstone.csv vernier.csv phyphox.csv tracker.txt; do cmp "samples/exports/$name" "$scratch/$name"; done
