#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Vernier's own velocities and accelerations come out of differentiate -M vernier to the last bit.
set -eu
export LC_ALL=C
unset CDPATH
file="${REAL_DATA:-}/cart-vernier/Project oefenbestand 1.csv"
[ -r "$file" ] ||
  { echo "skipped: REAL_DATA names no folder with cart-vernier; see tests/recordings.md"; exit 77; }
check() {  # COLUMN, and the field that holds what is in the file; the new column is the last one
  differentiate -M vernier -c "$1" "$file" | grep -v '^#' | cut -f "$2,5" |
    awk -v of="$1" '$1 + 0 != $2 + 0 { wrong++ } END { if (NR != 304 || wrong) { print of ": " NR " rows, " wrong " differ"; exit 1 } }'
}
check x 3
check v 4
# The comparison can fail: another method does not pass it.
if differentiate -M pasco -c x "$file" | grep -v '^#' | awk '$3 + 0 != $5 + 0 { exit 1 }'; then echo "pasco's rule passes for Vernier's"; exit 1; fi
