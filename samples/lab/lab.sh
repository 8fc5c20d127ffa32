#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# lab.sh [OPTION]... -K K -R R FILE|FOLDER...: finds the free rolls of all runs, the law of each run, the
# joint law, and draws a figure. A file may hold several runs. All files of a folder are read.
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
#   --accept RUN  let this run, or a file without one, pass; may be repeated
#
# lab.sh names a file that it cannot use, and goes on; with --check a table without a run fails. It replaces
# earlier results when all new ones are ready. It does not touch a folder that it did not make.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/../script.sh"
c=x slope=0 o=results
options '-K -R -m -c --slope --use... -o --check! --accept...' "$@"
[ "$K" ] && [ "$R" ] || wrong 'say what rolled: -K 0.5 -R 0.04'
case $c in
  x) route=position speeds=differentiate ;;
  v) route=velocity speeds=smooth ;;
  *) wrong "-c $c: x or v" ;;
esac
[ ! -e "$o" ] || [ -e "$o/made-by-lab" ] ||
  wrong "$o exists, and lab.sh did not make it: choose another folder with -o"
say() { printf 'lab.sh: %s\n' "$*" >&2; }
make_scratch
new=$scratch/new table=$scratch/new/table.txt failed=''
mkdir "$new"
: >"$new/made-by-lab"

files=() used=() unread=()
shopt -s nullglob
for operand in ${operands[@]+"${operands[@]}"}; do
  if [ -d "$operand" ]; then files+=("$operand"/*); else files+=("$operand"); fi
done
roll() { smooth --coast -c "$c" ${use[@]+"${use[@]/#/--use=}"} "$@"; }
is_among() {  # WORD LIST...
  local word=$1 one
  for one in "${@:2}"; do [ "$one" != "$word" ] || return 0; done
  return 1
}
# Notes and pictures may lie beside the runs; a table, or what should be one, is a run.
holds_rows() {
  [[ ! -f $1 || ${1,,} == *.csv || ${1,,} == *.tsv ]] || [ "$(grep -acE '^[-+"]?[0-9.]' "$1")" -ge 10 ]
}
for file in ${files[@]+"${files[@]}"}; do
  if roll -q -- "$file" >/dev/null 2>"$scratch/said"; then used+=("$file")
  else
    say "passed over: ${file##*/}: $(tail -n 1 "$scratch/said")"
    ! holds_rows "$file" || unread+=("${file##*/}")
  fi
done
[ ${#used[@]} -gt 0 ] ||
  wrong "there is no run to be fitted$([ "$c" = v ] || [ ${#files[@]} = 0 ] || echo '; if the files have speeds alone: -c v')"
over=$((${#files[@]} - ${#used[@]}))
case $over,$K,$R,$m in [1-9]*,*,*,*,*) wrong 'a file was passed over: which run has which K, R or m?' ;; esac
roll -- "${used[@]}" >"$scratch/rolls"
named "$scratch/rolls" "${used[0]}" >"$new/rolls"
runs=$(grep -c '^## run ' "$new/rolls")

fit() { fitpower --digits 6 --route $route -K "$K" -R "$R" --slope "$slope" "$@"; }
accepted=() checks=() each=()
if [ "$check" ]; then
  for run in ${accept[@]+"${accept[@]}"}; do
    is_among "$run" ${unread[@]+"${unread[@]}"} || accepted+=("--accept=$run")
  done
  checks=(--check ${accepted[@]+"${accepted[@]}"})
  [ "$c" = v ] || each=(-q "${checks[@]}")
fi
if [ "$slope" = fit ]; then
  fit "$new/rolls" >"$new/slope.txt"
  slope=$(columns "$new/slope.txt" slope)
fi
fit --each ${each[@]+"${each[@]}"} "$new/rolls" >"$table" || {
  status=$?
  [ "$(grep -vc '^#' "$table")" = "$runs" ] || exit $status
  [ $status = 1 ] || say 'some runs have no law'
  failed=${check:+1}
}
for file in ${unread[@]+"${unread[@]}"}; do
  [ "$check" ] && ! is_among "$file" ${accept[@]+"${accept[@]}"} || continue
  say "$file: no run was found in this table; if it is none, --accept '$file'"
  failed=1
done
law=$table
if [ "$runs" -gt 1 ]; then
  law=$new/joint.txt
  fitpower --digits 6 ${checks[@]+"${checks[@]}"} --route fits "$table" >"$law" || {
    [ $? = 1 ] || exit 1
    failed=1
    [ "$slope" != 0 ] || awk "BEGIN { exit ($(columns "$law" p) < 0.01) }" ||
      say 'if the runs rolled in both directions: --slope fit'
  }
fi
cat "$law"
if command -v gnuplot >/dev/null; then
  "$(dirname "$0")/../figures/fig4.sh" -c "$c" -K "$K" -R "$R" --slope "$slope" "$new/rolls" \
    >"$new/fig4.svg" 2>"$scratch/said" || { rm "$new/fig4.svg" && say "no figure: $(tail -n 1 "$scratch/said")"; }
fi
if [ "$check" ] && [ "$m" ]; then
  $speeds -q -c "$c" -M savgol -w "$(window 0.84 "$new/rolls" 5)" "$new/rolls" |
    energy-ledger -m "$m" --law "$table" --summary --digits 6 --check 0.05 ${accepted[@]+"${accepted[@]}"} \
      >"$new/energy.txt" || { [ $? = 1 ] || rm "$new/energy.txt"; failed=1; }
fi
[ -z "$check" ] || [ -z "$failed" ] || say 'failed: see the lines above'
[ -z "$check" ] || [ "$failed" ] ||
  echo "passed: $runs run$([ "$runs" = 1 ] || echo s)$([ $over = 0 ] || echo ", files passed over: $over")" >&2

replace=1
mkdir -p "$o"
place "$o" "$new"/*
for name in slope.txt joint.txt energy.txt fig4.svg; do
  [ -e "$new/$name" ] || rm -f "$o/$name"
done
exit "${failed:-0}"
