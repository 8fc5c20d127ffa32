#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# PASCO's own velocities and accelerations come out of differentiate -M pasco within the rounding of
# the file: positions to 0.01 m and velocities to 0.01 m/s at 50 Hz, so 4 * 0.005 / (6 * 0.02) and
# the last digit of the result.
set -eu
export LC_ALL=C
unset CDPATH
file="${REAL_DATA:-}/falling-coffee-filters/data_for_coffee.csv"
[ -r "$file" ] ||
  { echo "skipped: REAL_DATA names no folder with falling-coffee-filters; see tests/recordings.md";
    exit 77; }
check() {  # COLUMN, the field that holds what is in the file, RUN, the first row inside
  # the new column is the last one; what has fewer fields is padding of the file
  differentiate -q -M pasco -c "$1" --run "$3" "$file" |
    awk -F'\t' -v of="$1 run $3" -v field="$2" -v first="$4" '
    !/^#/ { n++; there[n] = $field; here[n] = $NF }
    END {
      for (i = first; i <= n + 1 - first; i++) if (there[i] != "") {
        rows++; d = there[i] - here[i]; if (d * d > worst) worst = d * d }
      if (rows < 50 || sqrt(worst) > 4 * 0.005 / (6 * 0.02) + 0.005 + 1e-9) {
        print of ": " rows + 0 " rows, off by " sqrt(worst); exit 1 }
    }'
}
for run in 2 3 4 5 6 8 9 10 11 12; do
  check x 3 "$run" 3
  check v 4 "$run" 3  # the first and the last velocity are blank there and left out
done
