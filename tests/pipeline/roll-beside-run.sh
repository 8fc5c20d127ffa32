#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The roll of a fitted row stands beside the run that it was fitted to, row by row: the residuals of
# `simulate --law fit --at run` have the rms of the row, whenever and wherever the run begins, towards
# growing and falling x, on a slope and over a turning point, and under laws that are no power of v.
set -u
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 2
export LC_ALL=C
wrong=0 tried=0

# beside COLUMN PARAMETERS OPTION...: fits the column of the file run.
beside() {
  local column=$1 parameters=$2
  shift 2
  fitpower -q -K 0.5 -R 0.04 "$@" run >fit
  simulate --law fit -K 0.5 -R 0.04 "${slope[@]}" --at run --columns t,"$column" | grep -v '^#' >law
  tried=$((tried + 1))
  grep -v '^#' run | paste - law | awk -v file=fit -v parameters="$parameters" -v told="$column $*" -F '\t' '
    BEGIN { while ((getline <file) > 0) { if (/^# /) n = split($0, name); else split($0, row) }
      for (i = 1; i <= n; i++) if (name[i] == "rms") rms = row[i] }
    { if ($1 != $3) { print "another time: " $0; bad = 1 } sum += ($2 - $4)^2 }
    END { found = sqrt(sum / (NR - parameters))
      if (bad || NR < 20 || (found / rms - 1)^2 > 1e-12) { print told ": rms " rms ", beside the run " found; exit 1 } }' ||
    { wrong=$((wrong + 1)); cat fit; }
}

# run COLUMN NOISE OPTION...: a roll with noise, and its options.
run() {
  local column=$1 noise=$2
  shift 2
  simulate -K 0.5 -R 0.04 "$@" --columns t,"$column" --dt 0.04 |
    awk -v noise="$noise" -F '\t' -v OFS='\t' '/^#/ { if (!/^##/) print; next }
      { $2 += noise * sin(37 * NR * NR); print }' >run
}
times=(-12.5 1e4)
[ -z "${LONG-}" ] || times=(-12.5 0 1.72 1e4)
for t0 in "${times[@]}"; do
  for way in '' -; do
    for law in '-a 1.87e-3 -b 0.215' '-a 5.75e-4 -b 0.0244'; do
      slope=()
      # shellcheck disable=SC2086  # options and their numbers
      run x 3e-4 $law --v0 ${way}0.5 --t0 "$t0" --x0 0.7 && beside x 4
      # shellcheck disable=SC2086
      run v 2e-3 $law --v0 ${way}0.5 --t0 "$t0" && beside v 3
      slope=(--slope 0.002)
      # shellcheck disable=SC2086
      run x 3e-4 $law --v0 ${way}0.5 --t0 "$t0" --x0 -2 "${slope[@]}" && beside x 4 "${slope[@]}"
    done
    slope=()
    for law in 'd0[m] d2[s^2/m]|1e-3 2e-3|d0 + d2 v^2' 'd0[m] d1[s]|8e-4 1.2e-3|d0+d1*v' 'd0[m] p[m] w[m/s]|4e-4 5e-4 0.2|d0 + 2 p v w/(v^2 + w^2)'; do
      IFS='|' read -r names values form <<<"$law"
      printf '%s\n' "$names" "$values" >row
      run x 3e-4 --law row --v0 ${way}0.6 --t0 "$t0" && beside x $((2 + $(wc -w <<<"$names"))) --law "$form"
    done
    # Up, the turning point and back; the slope is in the row.
    slope=()
    run x 3e-4 -a 5e-4 -b 0.1 --v0 ${way}0.5 --t0 "$t0" --slope ${way}0.05 --x0 0.3 --until "$(awk "BEGIN { print $t0 + 3 }")" &&
      beside x 5 --slope fit
  done
done
echo "$tried runs, $wrong wrong"
[ "$wrong" = 0 ] && [ "$tried" = $((20 * ${#times[@]})) ]
