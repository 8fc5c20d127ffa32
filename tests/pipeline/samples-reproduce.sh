#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make samples` makes the raw runs again byte for byte.
set -eu
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
make -n samples | sed -n '/^set -e; seed=/,/^done/p' >"$scratch/recipe"
[ -s "$scratch/recipe" ] || { echo "no recipe"; exit 1; }
mkdir "$scratch/samples" && cp samples/*.toml "$scratch/samples" && ln -s "$PWD/bin" "$scratch/bin"
(cd "$scratch" && bash -eu recipe)
for name in CF CR SF SR; do cmp "samples/$name.csv" "$scratch/samples/$name.csv"; done
samples/exports/make.sh "$scratch"
for name in capstone.csv vernier.csv phyphox.csv tracker.txt; do cmp "samples/exports/$name" "$scratch/$name"; done
