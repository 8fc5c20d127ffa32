#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# lab.sh [OPTION]... -K K -R R FILE|FOLDER...: the free rolls of all runs, the law of each, the law of
# all and a figure. A file may hold several runs; of a folder the files .csv, .tsv and .txt count.
#
#   -K, -R        shape factor and radius [m], one or one for each run in order: 0.5,0.83
#   -c x|v        fit positions (x) or velocities (v)
#   --slope S     slope of the mat, or fit: from runs in both directions
#   --use NAME=COLUMN  which column serves as t, x or v; may be repeated
#   -o FOLDER     where the results go (results): table.txt, joint.txt, fig4.svg and others
#   --check       exit with 1 unless each run has a law a v^b, all have one law, and, with -m, the
#                 energy and the momenta of each balance within 5 %
#   -m M          mass [kg], one or one for each run
#   --accept RUN  do not check this run by itself; may be repeated
#
# A file that cannot be used is named and passed over. Results replace those of an earlier run when
# all of them are made. A folder that lab.sh did not make is not touched.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/../script.sh"
K='' R='' m='' column=x slope=0 results=results check=false use=() accepted=()
while [ $# -gt 0 ]; do
  case $1 in
    --check) check=true; shift; continue ;;
    --) shift; break ;;
    -?*) [ $# -gt 1 ] || wrong "$1 needs a value" ;;
    *) break ;;
  esac
  case $1 in
    -K) K=$2 ;;
    -R) R=$2 ;;
    -m) m=$2 ;;
    -c) column=$2 ;;
    --slope) slope=$2 ;;
    --use) use+=(--use "$2") ;;
    --accept) accepted+=("$2") ;;
    -o) results=$2 ;;
    *) wrong "$1 is no option; lab.sh --help lists them" ;;
  esac
  shift 2
done
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
for operand; do
  [ -d "$operand" ] || { files+=("$operand") && continue; }
  for file in "$operand"/*; do
    case $file in
      *.[cC][sS][vV] | *.[tT][sS][vV] | *.[tT][xX][tT]) files+=("$file") ;;
      *) [ ! -f "$file" ] || say "left out, since it ends in none of .csv, .tsv, .txt: ${file##*/}" ;;
    esac
  done
done
roll() { smooth --coast -c $column ${use[@]+"${use[@]}"} -- "$@"; }
used=()
for file in ${files[@]+"${files[@]}"}; do
  if roll "$file" >"$scratch/roll" 2>"$scratch/said"; then
    used+=("$file")
  else
    say "passed over: ${file##*/}: $(tail -n 1 "$scratch/said")"
  fi
done
[ ${#used[@]} -gt 0 ] || wrong 'there is no run to be fitted'
case $K,$R,$m in
  *,*,*,*) [ ${#used[@]} = ${#files[@]} ] || wrong 'a file was passed over: which run has which K, R or m?' ;;
esac

new=$scratch/new
mkdir "$new"
roll "${used[@]}" >"$new/rolls"
grep -q '^## run ' "$new/rolls" || {
  printf '## run %s\n' "$(printf %s "${used[0]##*/}" | tr '[:cntrl:]' '?')"
  cat "$new/rolls"
} >"$scratch/named" && [ ! -s "$scratch/named" ] || mv "$scratch/named" "$new/rolls"
runs=$(grep -c '^## run ' "$new/rolls")
fit() { fitpower --digits 6 --route $route -K "$K" -R "$R" "$@"; }
if [ "$slope" = fit ]; then
  fit --slope fit "$new/rolls" >"$new/slope.txt"
  slope=$(awk -F '\t' '/^# / { for (i = 1; i <= NF; i++) if ($i == "slope") s = i; next }
    !/^#/ { print $s }' "$new/slope.txt")
fi
fit --slope "$slope" --each "$new/rolls" >"$new/table.txt" || say 'some runs have no law'
if [ "$runs" -gt 1 ]; then
  fitpower --digits 6 --route fits "$new/table.txt" >"$new/joint.txt"
  cat "$new/joint.txt"
else
  cat "$new/table.txt"
fi
if command -v gnuplot >/dev/null; then
  "$(dirname "$0")/../figures/fig4.sh" -c "$column" -K "$K" -R "$R" --slope "$slope" "$new/rolls" \
    >"$scratch/fig4.svg" 2>"$scratch/said" && mv "$scratch/fig4.svg" "$new" ||
    say "no figure: $(tail -n 1 "$scratch/said")"
fi

failed=0
check_run() {  # NUMBER
  [ "$column" = v ] || fitpower -q --check --run "$1" --route position -K "$(of_run "$K" "$1")" \
    -R "$(of_run "$R" "$1")" --slope "$slope" "$new/rolls" >/dev/null || return 1
  [ "$m" ] || return 0
  if [ "$column" = x ]; then differentiate -q -c x -M savgol -w 21 --run "$1" "$new/rolls"
  else smooth -q -c v -M savgol -w 21 --run "$1" "$new/rolls"; fi |
    energy-ledger -m "$(of_run "$m" "$1")" --law "$new/table.txt" --summary --check 0.05 \
      >>"$new/energy.txt"
}
is_accepted() {
  local name
  for name in ${accepted[@]+"${accepted[@]}"}; do [ "$name" != "$1" ] || return 0; done
  return 1
}
if $check; then
  [ "$runs" -lt 2 ] || fitpower -q --check --route fits "$new/table.txt" >/dev/null || { say 'the runs do not have one law'; failed=1; }
  number=0
  while IFS= read -r name; do
    number=$((number + 1))
    ! is_accepted "$name" || continue
    check_run $number || { say "the check fails: run $name"; failed=1; }
  done < <(sed -n 's/^## run //p' "$new/rolls")
  [ $failed = 1 ] || echo "passed: $runs runs" >&2
fi

replace=1
mkdir -p "$results"
: >"$new/made-by-lab"
place "$results" "$new"/*
for name in slope.txt joint.txt energy.txt fig4.svg; do
  [ -e "$new/$name" ] || rm -f "$results/$name"
done
exit $failed
