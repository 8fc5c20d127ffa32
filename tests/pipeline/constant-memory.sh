#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A million rows through each filter in the memory of a window: 24 MiB of address space, libraries included.
set -eu
export LC_ALL=C
unset CDPATH
if grep -q __asan_init bin/smooth; then echo 'skipped: a sanitizer takes more than these tools'; exit 77; fi
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
awk 'BEGIN { for (i = 0; i < 1000000; i++) printf "%.2f\t%.4f\t%.5f\n", i / 25, 0.5 + sin(i / 1000) / 4, 1e-3 }' >"$scratch"
check() {  # NAME COMMAND...
  local count
  count=$( (ulimit -v 24576; exec "$@") <"$scratch" | wc -l)
  [ "$count" -ge 1000000 ] || { echo "$1: $count rows"; exit 1; }
}
check smooth --width 101
check smooth --seconds 4
check smooth -M savgol
check smooth -M median
check smooth -q --outliers 9 --from 0
check differentiate
check differentiate -M savgol
check differentiate -M vernier
check differentiate -M pasco
check shift-from-accel --use a=3 -K 0.5 -R 0.04
check energy-ledger -m 1 -K 0.5 -R 0.04
