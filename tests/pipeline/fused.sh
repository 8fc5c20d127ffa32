#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Flags that fuse a multiplication and an addition (-march with FMA, arm64 by itself) change no bit of a roll: the project's own
# flags, behind them, forbid it. build/fused/ has the same sources without them and with them.
set -eu
# Flags that let the compiler drop the exact sums are refused in one line, whatever the processor.
for flag in -ffast-math -Ofast -ffinite-math-only; do
  # shellcheck disable=SC2086  # the compiler may be two words
  said=$(${CXX:-g++} $flag -std=c++20 -Ilib -E -x c++ lib/base/two_sum.h 2>&1 >/dev/null) && exit 1
  [ "$(grep -c 'error:.*build it without -ffast-math' <<<"$said")" = 1 ] || { echo "$said"; exit 1; }
done
[ -x build/fused/fused ] || { echo 'this processor has no x86-64-v3'; exit 77; }
trap 'rm -f "$plain"' EXIT
plain=$(mktemp)
build/fused/plain >"$plain"
[ "$(wc -l <"$plain")" -gt 8000 ]
build/fused/fused | cmp - "$plain"

# Sums of windows.
filtered() {  # FOLDER OF THE TOOLS
  local name
  for name in CF CR SF SR; do
    "$1/smooth" -q -w 1 "samples/$name.csv"
    "$1/smooth" -q -c x -w 11 "samples/$name.csv" | "$1/differentiate" -c x
    "$1/smooth" -q -M savgol -w 7 "samples/$name.csv" | "$1/differentiate" -M savgol -w 9
  done
}
filtered bin >"$plain"
[ "$(wc -l <"$plain")" -gt 1500 ]
filtered build/fused/bin | cmp - "$plain"
