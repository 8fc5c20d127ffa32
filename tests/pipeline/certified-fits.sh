#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fitpower beside the certified fits of tests/reference/fits.
#
#   tests/pipeline/certified-fits.sh [table]
#
# With `table` it prints how many digits of each number are right.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0 files=0
for file in tests/reference/fits/*.dat; do
  files=$((files + 1))
  command=$(sed -n 's/^Command:  *//p' "$file")
  case $command in
    *position*) y='x[m]' ;;
    *) y='v[m/s]' ;;
  esac
  # The data are y, x and, if there are several, the number of the run.
  awk -v y="$y" '
    data && NF == 3 && $3 != run {
      if (run) print ""
      run = $3
    }
    data { print $2 "\t" $1 }
    /^Data:   y/ { data = 1; print "# t[s]\t" y }' "$file" >"$scratch/run"
  # shellcheck disable=SC2086  # words
  $command -q "$scratch/run" >"$scratch/row" &&
    awk -v table="${1-}" -f tests/reference/right-digits.awk "$scratch/row" "$file" ||
    { echo "$file: $command" && wrong=1; }
done
[ "$files" -ge 24 ] || { echo "only $files certified fits" && wrong=1; }
exit $wrong
