#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fuzz.sh FOLDER SECONDS TARGET...: runs each fuzzer of FOLDER for so long, beginning from tests/fuzz/corpus; ends with a table
# of executions and findings. What it finds stays in FOLDER/found.
set -u
export LC_ALL=C
unset CDPATH
folder=$1 seconds=$2
shift 2
found=0
mkdir -p "$folder/found"
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1024:detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
for target; do
  mkdir -p "$folder/corpus/$target"
  "$folder/$target" -max_total_time="$seconds" -max_len=2000 -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$folder/found/$target-" "$folder/corpus/$target" "tests/fuzz/corpus/$target" >"$folder/$target.log" 2>&1
  status=$?
  runs=$(sed -nE 's/^stat::number_of_executed_units: //p' "$folder/$target.log")
  covered=$(grep -oE 'cov: [0-9]+' "$folder/$target.log" | tail -n 1)
  printf '%-18s %10s runs  %s  exit %s\n' "$target" "${runs:-?}" "$covered" "$status"
  [ $status = 0 ] || { found=1 && grep -E "ERROR|runtime error|: '|SUMMARY|Test unit" "$folder/$target.log" | cut -c1-300; }
done
exit $found
