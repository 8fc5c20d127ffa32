#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Where the work of a row goes: instructions a row by what they do, counted by callgrind, of each tool and of the bare loop that it is
# measured against.
#
#   tests/bench/profile.sh [ROWS]
#
# Needs the files of speed.sh in build/speed/, build/bench/speed, valgrind, and the tools on the PATH. Counts do not depend on
# what else the machine does; ROWS rows (20000) are those by which one run is longer than another.
set -euo pipefail
export LC_ALL=C
unset CDPATH
command -v valgrind >/dev/null ||
  { echo 'profile.sh: without valgrind there is no profile' >&2; exit 0; }
rows=${1:-20000}
speed=$PWD/build/bench/speed
cd build/speed

# A line is `count (share) file:function [object]`. The last part that fits counts.
by_part='
{ n = $1; gsub(/,/, "", n); sub(/^[^)]*\) /, ""); sub(/ \[[^]]*\]$/, ""); part = "other" }
/rolling::|main|e_log|log@/ { part = "computing" }
/lagged|ljung_box|breusch_pagan|are_held/ { part = "testing" }
/rolling::(Reader|Lines|Input|Dialect|Layout)|read_runs|memchr/ { part = "reading" }
/rolling::(RowPipe|Output)|mem(move|cpy)|Writer::/ { part = "writing" }
/read_number|read_any_number|rolling::.*divide|from_chars/ { part = "parsing" }
/append_number|eight_digits|to_decimal|fmt::/ { part = "formatting" }
{ sum[part] += n; sum["all"] += n }
END { for (p in sum) print p, sum[p] }'

count() {  # FILE COMMAND...: instructions by part
  valgrind --tool=callgrind --callgrind-out-file=callgrind.out "${@:2}" <"$1" >/dev/null 2>&1
  callgrind_annotate --auto=no --threshold=100 callgrind.out | grep -E '^ *[0-9,]+ \(' | grep -v 'PROGRAM TOTALS' | awk "$by_part"
}
parts='reading parsing computing testing formatting writing other all'
line() {  # WHAT FILE COMMAND...: where the command takes no file, ROWS in it is the number of rows
  local what=$1
  head -n $((rows + 1)) "$2" >few.txt
  head -n $((2 * rows + 1)) "$2" >many.txt
  shift 2
  count few.txt "${@//ROWS/$rows}" >few.count
  count many.txt "${@//ROWS/$((2 * rows))}" >many.count
  awk -v what="$what" -v n="$rows" -v parts="$parts" '
    NR == FNR { few[$1] = $2; next }
    { many[$1] = ($2 - few[$1]) / n }
    END {
      printf "%-18s", what
      for (i = 1; i <= split(parts, part, " "); i++) printf " %10d", many[part[i]] + 0.5
      print ""
    }' few.count many.count
}

printf '%-18s' '# instructions'
for part in $parts; do printf ' %10s' "$part"; done
echo
line smooth tv.txt smooth
line differentiate tv.txt differentiate
line shift-from-accel tva.txt shift-from-accel -K 0.5 -R 0.04
line 'bare loop' tv.txt "$speed" filter
line '  quoted: smooth' quoted.csv smooth
line '  quoted: bare' quoted.plain "$speed" filter
line energy-ledger tvD.txt energy-ledger -m 1.375 -K 0.5 -R 0.04
line 'bare loop, 10' tvD.txt "$speed" filter 10
line '  --summary' tvD.txt energy-ledger --summary -m 1.375 -K 0.5 -R 0.04
line 'fitpower loglog' vD.txt fitpower -q --route loglog
line 'bare loop, fit' vD.txt "$speed" fit
line 'simulate t,v' tv.txt simulate -K 0.5 -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5 --dt 1e-5 --until ROWSe-5 --columns t,v
line 'bare loop, print' tv.txt "$speed" print ROWS
