#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# lab-rates.sh [FOLDERS [RUNS...]]: what `samples/lab/lab.sh --check` says of FOLDERS (20) simulated
# folders of 7 and of 50 RUNS on rubber: of good ones, and of those in which the D of one run is off by
# 1, 2 or 4 %. A row for each: how many fail, and in how many the run that is off is named.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../../samples"
folders=${1:-20}
[ $# -gt 1 ] || set -- "$folders" 7 50
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/runs"
a=$(sed -n 's/^coefficient *= *//p' CR.toml)
raw() { simulate --scene CR.toml -a "$(awk "BEGIN { print $a * $1 }")" --sensor pasco --seed "$seed" >"$scratch/runs/$2.csv"; }

printf '# runs\toff[%%]\tfolders\tfail\tnamed\n'
seed=0
for runs in "${@:2}"; do
  for ((folder = 0; folder < folders; folder++)); do
    for ((run = 1; run <= runs; run++)); do seed=$((seed + 1)) && raw 1 "$run"; done
    for off in 0 1 2 4; do
      [ $off = 0 ] || raw "1.0$off" 3
      status=0
      lab/lab.sh --check -K 0.5 -R 0.04 -m 1.375 -o "$scratch/results" "$scratch/runs" >/dev/null 2>"$scratch/said" || status=$?
      named=$(grep -Ec -m 1 'run 3[.]csv( is furthest|:)' "$scratch/said" || true)
      printf '%d\t%d\t%d\t%d\n' "$runs" $off $status "$named"
    done
  done
done | awk -F '\t' -v OFS='\t' '
  { key = $1 OFS $2; if (!n[key]++) order[++keys] = key; fail[key] += $3 > 0; named[key] += $4 }
  END { for (i = 1; i <= keys; i++) print order[i], n[order[i]], fail[order[i]], named[order[i]] }'
