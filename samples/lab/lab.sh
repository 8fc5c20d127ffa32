#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# lab.sh [OPTION]... -K K -R R FILE|FOLDER...: finds the free rolls of all runs, the law of each run, the
# joint law, and draws a figure. A file may hold several runs. In a folder the files .csv, .tsv and .txt
# are read.
#
#   -K, -R        shape factor and radius [m], one or one for each run in order: 0.5,0.83
#   -c x|v        fit positions (x) or velocities (v)
#   --slope S     slope of the mat; fit: find it, from runs in both directions
#   --use NAME=COLUMN  use this column as t, x or v; may be repeated
#   -o FOLDER     folder of the results (results): table.txt, joint.txt, fig4.svg and others
#   --check       exit with 1 unless each run has a law a v^b, all runs agree, and, with -m, the energy
#                 and the momenta of each run add up within 5 %; 1 % of good folders fail, however many
#                 runs they have
#   -m M          mass [kg], one or one for each run
#   --accept RUN  do not check this run by itself; may be repeated
#
# lab.sh names a file that it cannot use, and goes on. It replaces earlier results when all new ones are
# ready. It does not touch a folder that it did not make.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/../script.sh"
c=x slope=0 o=results
options '-K -R -m -c --slope --use... -o --check! --accept...' "$@"
column=$c results=$o
[ "$K" ] && [ "$R" ] || wrong 'say what rolled: -K 0.5 -R 0.04'
case $column in
  x) route=position ;;
  v) route=velocity ;;
  *) wrong "-c $column: x or v" ;;
esac
say() { printf 'lab.sh: %s\n' "$*" >&2; }
[ ! -e "$results" ] || [ -e "$results/made-by-lab" ] ||
  wrong "$results exists, and lab.sh did not make it: choose another folder with -o"
make_scratch

files=()
for operand in ${operands[@]+"${operands[@]}"}; do
  [ -d "$operand" ] || { files+=("$operand") && continue; }
  for file in "$operand"/*; do
    case $file in
      *.[cC][sS][vV] | *.[tT][sS][vV] | *.[tT][xX][tT]) files+=("$file") ;;
      *) [ ! -f "$file" ] || say "left out, since it ends in none of .csv, .tsv, .txt: ${file##*/}" ;;
    esac
  done
done
roll() { smooth --coast -c $column ${use[@]+"${use[@]/#/--use=}"} -- "$@"; }
used=(${files[@]+"${files[@]}"})
if [ ${#used[@]} -gt 0 ] && roll "${used[@]}" >"$scratch/rolls" 2>"$scratch/said"; then
  cat "$scratch/said" >&2
else
  used=()
  for file in ${files[@]+"${files[@]}"}; do
    if roll "$file" >/dev/null 2>"$scratch/said"; then used+=("$file")
    else say "passed over: ${file##*/}: $(tail -n 1 "$scratch/said")"; fi
  done
  [ ${#used[@]} -gt 0 ] || wrong 'there is no run to be fitted'
  roll "${used[@]}" >"$scratch/rolls"
fi
case $K,$R,$m in
  *,*,*,*) [ ${#used[@]} = ${#files[@]} ] || wrong 'a file was passed over: which run has which K, R or m?' ;;
esac

new=$scratch/new
mkdir "$new"
named "$scratch/rolls" "${used[0]}" >"$new/rolls"
runs=$(grep -c '^## run ' "$new/rolls")
# What each run loses is as its mass, and how it closes is not.
balance() {
  if [ $column = x ]; then differentiate -q -c x -M savgol -w 21 "$1"
  else smooth -q -c v -M savgol -w 21 "$1"; fi |
    energy-ledger -m 1 --law "$new/table.txt" --summary --digits 6 --check 0.05 |
    awk -F '\t' -v OFS='\t' -v list="$m" 'BEGIN { n = split(list, m, ",") }
      /^#/ { for (i = 1; i <= NF; i++) energy[i] = $i ~ /\[J\]/ }
      !/^#/ && NF { row++; for (i in energy) if (energy[i] && $i != "") $i *= n > 1 ? m[row] : list }
      { print }'
}
fit() { fitpower --digits 6 --route $route -K "$K" -R "$R" --slope "$slope" "$@"; }
if [ "$slope" = fit ]; then
  fit "$new/rolls" >"$new/slope.txt"
  slope=$(columns "$new/slope.txt" slope)
fi
fit --each "$new/rolls" >"$new/table.txt" || say 'some runs have no law'
law=$new/table.txt failed=0
if [ "$runs" -gt 1 ]; then
  law=$new/joint.txt
  fitpower --digits 6 ${check:+--check} --route fits "$new/table.txt" >"$law" || { [ $? = 1 ] && failed=1; }
  [ $failed = 0 ] || [ "$slope" != 0 ] || say 'if the runs rolled in both directions: --slope fit'
fi
cat "$law"
if command -v gnuplot >/dev/null; then
  "$(dirname "$0")/../figures/fig4.sh" -c "$column" -K "$K" -R "$R" --slope "$slope" "$new/rolls" \
    >"$scratch/fig4.svg" 2>"$scratch/said" && mv "$scratch/fig4.svg" "$new" ||
    say "no figure: $(tail -n 1 "$scratch/said")"
fi

if [ "$check" ]; then
  # The runs that are checked by themselves; their numbers; and what K, R and m say of them.
  : >"$scratch/kept"
  printf '## run %s\n' '' ${accept[@]+"${accept[@]}"} >"$scratch/accepted"
  awk -F '\n' -v kept="$scratch/kept" 'NR == FNR { accepted[$0]; next }
    !($1 in accepted) { print; printf "%d\n", FNR >kept }' "$scratch/accepted" RS= ORS='\n\n' "$new/rolls" >"$scratch/checked"
  of_kept() {
    awk -v list="$1" 'BEGIN { n = split(list, of, ","); if (n == 1) print list }
      n > 1 { printf "%s%s", (NR > 1 ? "," : ""), of[$1] }' "$scratch/kept"
  }
  K=$(of_kept "$K") R=$(of_kept "$R") m=$(of_kept "$m")
  if [ -s "$scratch/checked" ]; then
    [ $column = v ] || fit -q --each --check "$scratch/checked" >/dev/null || failed=1
    [ -z "$m" ] || balance "$scratch/checked" >"$new/energy.txt" || failed=1
  fi
  over=$((${#files[@]} - ${#used[@]}))
  [ $failed = 1 ] || echo "passed: $runs runs$([ $over = 0 ] || echo ", files passed over: $over")" >&2
fi

replace=1
mkdir -p "$results"
: >"$new/made-by-lab"
place "$results" "$new"/*
for name in slope.txt joint.txt energy.txt fig4.svg; do
  [ -e "$new/$name" ] || rm -f "$results/$name"
done
exit $failed
