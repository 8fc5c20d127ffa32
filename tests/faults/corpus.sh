#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The fuzz targets on their corpus: what a fuzzer has found before stays mended.
. "$(dirname "$0")/tools"
for target in number reader scene $tools; do
  attempt "build/replay/$target" "tests/fuzz/corpus/$target"/*
  [ "$status" = 0 ] ||
    complain "$target: exit $status after $(tail -n 1 "$scratch/out"): $(head -c 500 "$scratch/err")"
done
finish
