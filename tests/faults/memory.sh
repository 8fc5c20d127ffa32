#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every allocation of every tool fails in turn, by itself and with all after it: each time one line
# and 2, never an abort. LONG=1 takes each of them, otherwise one of 61, or of 13.
. "$(dirname "$0")/tools"
preloads || { echo 'skipped: nothing can be preloaded into this build'; exit 77; }
good 40 >"$scratch/good"
printf 'radius = 0.04\nshape-factor = 0.5\nmass = 1\n' >"$scratch/scene"
step=61 each=13  # where few allocations are of interest
[ -z "${LONG:-}" ] || step=1 each=1

each_allocation() {  # COMMAND...
  local mode
  for mode in once on; do
    FAULT_MALLOC=$mode/$step LD_PRELOAD=$shim "$@" >"$scratch/says" || { wrong=1 && echo "$*:" && cat "$scratch/says"; }
    tried=$((tried + $(sed -nE 's/.*: ([0-9]+) allocations failed.*/\1/p' "$scratch/says")))
  done
}
for tool in $tools; do
  # shellcheck disable=SC2086
  each_allocation ${command[$tool]} "$scratch/good"
done
sed '7s/^/# a remark that needs more memory than the rows before it have: '"$(printf '%999s' x)"'\n/' "$scratch/good" >"$scratch/remark"
for file in good remark; do  # while a row or a remark is taken few fail
  step=$each each_allocation smooth -w 3 "$scratch/$file"
done
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 0.5 --dt 0.1 --columns t,v --digits 3 |
  smooth -w 3 | differentiate | shift-from-accel -K 0.5 -R 0.04 >"$scratch/filtered"
for route in loglog shift; do  # the filters are part of the fit, which takes a thousand times as many
  step=$((41 * step)) each_allocation fitpower -q --route $route "$scratch/filtered"
done
each_allocation smooth -M savgol --outliers 9 -u --digits 3 "$scratch/good"
each_allocation smooth -M median --coast "$scratch/good"
each_allocation differentiate -M spline "$scratch/good"
each_allocation fitpower --route velocity -K 0.5 --scene "$scratch/scene" "$scratch/good"
for method in rkf45 msadams rk4imp msbdf; do  # not bsimp: GSL does not look at five of its allocations, and asks malloc for them
  step=$((5 * step)) each_allocation simulate --scene "$scratch/scene" -a 1e-3 -b 0.2 --v0 0.5 --dt 0.5 --method $method
done
step=$each each_allocation simulate --scene "$scratch/scene" -a 1e-3 -b 0.2 --v0 0.5 --sensor pasco  # of which GSL makes but two
each_allocation energy-ledger --scene "$scratch/scene" --summary "$scratch/good"
step=$each each_allocation smooth --help  # of which a stream of the library may go on without memory
each_allocation smooth --version
finish
