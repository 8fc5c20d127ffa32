#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# make.sh FOLDER [RUNS [SPREAD]]: runs of a motion sensor, FOLDER/0001.csv on, each of a
# cylinder on a mat of its own, and FOLDER/truth.txt, the laws D = a v^b that made them. With the
# spread s (0.1), ln a is normal about ln 1.87e-3 with standard deviation s, b about 0.215 with s/5;
# v0 is uniform from 0.4 to 0.6 m/s. A run depends on its number alone: it is the same
# everywhere.
set -euo pipefail
export LC_ALL=C
unset CDPATH
[ $# -gt 0 ] || { echo "make.sh: say the folder: make.sh FOLDER [RUNS [SPREAD]]" >&2; exit 2; }
folder=$1 runs=${2:-1000} spread=${3:-0.1}
# The tools of this source, or those on the PATH.
PATH=$(cd "$(dirname "$0")/../.." && pwd)/bin:$PATH
mkdir -p -- "$folder"
awk -v runs="$runs" -v spread="$spread" '
  # Park and Miller 1988, Comm. ACM 31, 1192: exact in doubles
  function uniform() { state = 16807 * state % 2147483647; return state / 2147483647 }
  function normal() { return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()) }
  BEGIN {
    print "# run\ta[m]\tb\tv0[m/s]"
    for (i = 1; i <= runs; ++i) {
      state = 48271 * i % 2147483647
      for (k = 0; k < 10; ++k) uniform()
      a = 1.87e-3 * exp(spread * normal()); b = 0.215 + spread / 5 * normal()
      printf "%04d\t%.9g\t%.9g\t%.9g\n", i, a, b, 0.4 + 0.2 * uniform()
    }
  }' >"$folder/truth.txt"
grep -v '^#' "$folder/truth.txt" | while read -r run a b v0; do
  simulate -K 0.5 -R 0.04 -a "$a" -b "$b" --v0 "$v0" --sensor pasco --seed "$((10#$run))" \
    >"$folder/$run.csv"
done
