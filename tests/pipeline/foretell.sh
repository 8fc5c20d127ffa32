#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The law of a run foretells the way of slower and faster ones: over 15 sonar runs from 0.5 m/s (60 with
# LONG=1), the true way from another speed (Eq. 13, by hand) is as often within sigma_x as an
# uncertainty promises: by chance fewer are in one case of 1000, and so the sums of squares.
set -u
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
export LC_ALL=C
wrong=0
runs=15 least=11 squares='4.0 37'
[ -z "${LONG-}" ] || runs=60 least=51 squares='36 96'
for scene in "CR 1.87e-3 0.215" "CF 5.75e-4 0.0244"; do
  read -r name a b <<<"$scene"
  for seed in $(seq $runs); do
    simulate --scene "samples/$name.toml" --sensor pasco --seed "$seed" | smooth --coast -q -w 1 -c x |
      fitpower -q -K 0.5 -R 0.04 >"$scratch/fit" || exit 1
    for v in 0.2 0.5 0.8 1.2; do
      simulate -q --law "$scratch/fit" -K 0.5 -R 0.04 --v0 "$v" --x0 0 --t0 0 --dt 100 --columns x,sigma_x |
        awk -v v="$v" -v a="$a" -v b="$b" 'NR == 4 { way = v^(2 - b) / (a * (2 - b) * 9.81 / (1.5 * 0.04)); print v, ($1 - way) / $2 }'
    done
  done | awk -v name="$name" -v runs=$runs -v least=$least -v limits="$squares" 'BEGIN { split(limits, limit, " ") }
    { n[$1]++; covered[$1] += $2^2 < 1.96^2; squares[$1] += $2^2 }
    END { for (v in n) {
        if (n[v] == runs && covered[v] >= least && squares[v] > limit[1] && squares[v] < limit[2]) good++
        else print name " from " v ": " covered[v] " of " n[v] ", squares " squares[v]
      }
      exit good != 4 }' || wrong=1
done
exit $wrong
