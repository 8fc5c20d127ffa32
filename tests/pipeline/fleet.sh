#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# samples/fleet on a few runs: every one gets a row, whoever runs the jobs; the errors are as
# large as the distances from the truth; and the joint law and the scatter of the laws are those
# that made the runs.
set -eu
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$*"; exit 1; }

samples/fleet/make.sh "$scratch/run" 24
export SLURM_ARRAY_TASK_COUNT=2
for SLURM_ARRAY_TASK_ID in 0 1; do
  export SLURM_ARRAY_TASK_ID
  samples/fleet/slurm.sh -K 0.5 -R 0.04 "$scratch/run"
done 2>"$scratch/told"
awk '!/^#/ || !names++' "$scratch"/run/part.* | sort >"$scratch/table"
[ "$(grep -vc '^#' "$scratch/table")" = 24 ] &&
  [ "$(head -n 1 "$scratch/table" | tr '\t' '\n' | sed -n '1p;$p' | xargs)" = '# a[m] run' ] ||
    fail "$(cat "$scratch/table")"
awk -f samples/fleet/pulls.awk "$scratch/run/truth.txt" "$scratch/table"
# What the runs tell is told, like things of many runs once: most of the runs have lost an echo.
told() { grep -c 'smooth: [0-9]* rows* left out: a reading is missing; and [0-9]* more like it$' "$1" || :; }
[ "$(told "$scratch/told")" = 2 ] || fail "not a line of each task: $(cat "$scratch/told")"

# A run that cannot be fitted is named, ends in an error, and the others have their rows.
printf 't,x\n0,1\n1,1\n2,1\n' >"$scratch/run/still.csv"
export SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_ID=0
if samples/fleet/slurm.sh -K 0.5 -R 0.04 "$scratch/run" 2>"$scratch/told"; then fail 'still.csv is fitted'; fi
[ "$(awk '!/^#/ && $1' "$scratch/run/part.0" | grep -c .)" = 24 ] || fail "$(cat "$scratch/run/part.0")"
grep -q '^still.csv: smooth: ' "$scratch/told" || fail "still.csv is not named: $(cat "$scratch/told")"
if command -v parallel >/dev/null; then
  status=0
  HOME=$scratch samples/fleet/table.sh -K 0.5 -R 0.04 "$scratch/run" >"$scratch/parallel" 2>"$scratch/told" || status=$?
  [ $status = 1 ] && grep -q '^still.csv: smooth: ' "$scratch/told" && [ "$(told "$scratch/told")" = 1 ] ||
    fail "parallel: status $status: $(cat "$scratch/told")"
  awk '/^#/ || $1' "$scratch/parallel" | sort | diff "$scratch/table" - || fail "parallel makes another table"
fi
rm "$scratch/run/still.csv"

# What rolled is not guessed.
for script in fit.sh table.sh slurm.sh; do
  if samples/fleet/$script "$scratch/run" >/dev/null 2>"$scratch/told"; then fail "$script guesses K and R"; fi
  grep -q "$script: say what rolled" "$scratch/told" || fail "$script: $(cat "$scratch/told")"
done

# Laws that scatter by 0.1 in ln a, 0.02 in b: 24 of them tell that within a factor of 2 (chi
# square), and the mean within 4 of its errors.
fitpower -q --route fits "$scratch/table" | awk '!/^#/ {
  off_a = ($1 - 1.87e-3) / $2; off_b = ($3 - 0.215) / $4
  if (off_a^2 > 16 || off_b^2 > 16 || $6 < 0.05 || $6 > 0.2 || $7 < 0.01 || $7 > 0.04) {
    print "joint:", $0; exit 1 } }'

# One law for all: there is nothing that scatters, and the joint fit of the rows is that of fitpower
# on all runs at once.
samples/fleet/make.sh "$scratch/class" 12 0
for run in "$scratch"/class/*.csv; do samples/fleet/fit.sh -K 0.5 -R 0.04 "$run"; done 2>/dev/null | awk '!/^#/ || !names++' >"$scratch/table"
smooth -q --coast -c x -w 1 "$scratch"/class/*.csv |
  fitpower -q --route position -K 0.5 -R 0.04 >"$scratch/joint"
fitpower -q --route fits "$scratch/table" | tail -n 1 | cut -f 1-8 >"$scratch/of-rows"
tail -n 1 "$scratch/joint" | paste "$scratch/of-rows" - | awk '{
  far_a = ($1 - $9) / $10; far_b = ($3 - $11) / $12; wide = $4 / $12
  if ($6 > 0.02 || far_a^2 > 0.04 || far_b^2 > 0.04 || wide < 0.8 || wide > 1.25) {
    print "joint of the rows, and of the runs:", $0; exit 1 } }'
