#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# make.sh FOLDER: the sample runs in the forms in which other programs export them
# (`make samples`).
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/../script.sh"
[ $# = 1 ] && [ -d "$1" ] || wrong 'say one folder'
to=$(cd -- "$1" && pwd)
cd "$(dirname "$0")/.."
[ "$to" != "$PWD/exports" ] || replace=1
make_scratch

# PASCO Capstone: byte order mark, quoted names, runs side by side, the shorter filled up with
# blanks.
{
  printf '\xEF\xBB\xBF'
  awk -F, 'FNR == 1 { file++; next } { line[file, FNR] = $0 } FNR > rows { rows = FNR }
    function cells(run, i) { return (run, i) in line ? line[run, i] : ",," }
    END {
      names = "\"Time (s) Run #%d\",\"Position (m) Run #%d\",\"Velocity (m/s) Run #%d\"%s"
      for (run = 1; run <= 2; run++) printf names, run, run, run, (run < 2 ? "," : "\n")
      for (i = 2; i <= rows; i++) print cells(1, i) "," cells(2, i)
    }' CR.csv SR.csv
} >"$scratch/capstone.csv"

# Vernier Logger Pro: the data set before each name, the unit glued on.
sed '1s/.*/Data Set 1:Time(s),Data Set 1:Position(m),Data Set 1:Velocity(m\/s)/' SR.csv \
  >"$scratch/vernier.csv"

# phyphox: quoted names, nine decimals and an exponent, a distance in cm.
awk -F, '
  NR == 1 { print "\"Time (s)\",\"Distance (cm)\""; next }
  $2 != "" { printf "%.9E,%.9E\n", $1, 100 * $2 }' CF.csv >"$scratch/phyphox.csv"

# Tracker, in a locale with a decimal comma: the name of the track, then semicolons.
awk -F, '
  NR == 1 { print "mass_A\nt;x;y"; next }
  $2 != "" { row = sprintf("%.9E;%.9E;%.9E", $1, $2, 0); gsub(/\./, ",", row); print row }' \
  SF.csv >"$scratch/tracker.txt"
place "$to" "$scratch"/*
