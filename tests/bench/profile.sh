#!/bin/bash
# Where the work of a row goes: instructions a row by what they do, counted by callgrind, beside the bare loop.
#
#   tests/bench/profile.sh [ROWS]
#
# Needs the files of speed.sh in build/speed/, build/bench/speed, valgrind, and the tools on the PATH. Counts do not depend on
# what else the machine does; what a run of ten rows costs is taken off.
set -euo pipefail
export LC_ALL=C
unset CDPATH
export LC_ALL=C
command -v valgrind >/dev/null ||
  { echo 'profile.sh: without valgrind there is no profile' >&2; exit 0; }
rows=${1:-20000}
speed=$PWD/build/bench/speed
cd build/speed

# A line is `count (share) file:function [object]`.
by_part='
{ n = $1; gsub(/,/, "", n); sub(/^[^)]*\) /, ""); sub(/ \[[^]]*\]$/, ""); part = "other" }
/rolling::|main|speed/ { part = "computing" }
/rolling::(Reader|Lines|Input|Dialect|Layout)|memchr/ { part = "reading" }
/rolling::(Filter|Output)|mem(move|cpy)|Writer::/ { part = "writing" }
/read_number|read_any_number|rolling::.*divide|from_chars/ { part = "parsing" }
/write_number|write_shortest|write_eight_digits|to_decimal|fmt::/ { part = "formatting" }
{ sum[part] += n; sum["all"] += n }
END { for (p in sum) print p, sum[p] }'

count() {  # NAME FILE COMMAND...: instructions by part
  valgrind --tool=callgrind --callgrind-out-file=callgrind.out "${@:3}" <"$2" >/dev/null 2>&1
  callgrind_annotate --auto=no --threshold=100 callgrind.out | grep -E '^ *[0-9,]+ \(' | grep -v 'PROGRAM TOTALS' | awk "$by_part" >"$1"
}
line() {  # WHAT FILE COMMAND...
  head -n 11 "$2" >few.txt
  head -n $((rows + 11)) "$2" >many.txt
  count few.count few.txt "${@:3}"
  count many.count many.txt "${@:3}"
  awk -v what="$1" -v n="$rows" '
    NR == FNR { few[$1] = $2; next }
    { many[$1] = ($2 - few[$1]) / n }
    END { printf "%-18s %8.0f %8.0f %9.0f %10.0f %8.0f %6.0f %6.0f\n", what, many["reading"], many["parsing"], many["computing"], many["formatting"], many["writing"], many["other"], many["all"] }
  ' few.count many.count
}

printf '%-18s %8s %8s %9s %10s %8s %6s %6s\n' '# instructions' reading parsing computing formatting writing other all
line smooth tv.txt smooth
line differentiate tv.txt differentiate
line shift-from-accel tva.txt shift-from-accel -K 0.5 -R 0.04
line energy-ledger tvD.txt energy-ledger -m 1.375 -K 0.5 -R 0.04
line 'bare loop' tv.txt "$speed" filter
line 'bare loop, 10' tvD.txt "$speed" filter 10
