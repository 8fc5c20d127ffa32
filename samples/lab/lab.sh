#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# lab.sh [all|check]: the runs in a folder -> a fit of each -> one table and what they say together ->
# D(v) of all as a figure, in results/. The environment says what rolled:
#   records  the folder; its files *.csv, *.tsv and *.txt in either case are the runs, in order
#   K, R     shape factor and radius [m], one for all runs or one for each: 0.5,0.83
#   m        mass [kg]; column: x positions, or v velocities; slope: S or fit
#   use      NAME=COLUMN, or several with blanks between them: t=2[ms] x=Ort
# Everything is made anew each time: nothing is told of a run that is no longer there. `check` fails
# where a law or an energy balance does not hold. Names of files are never code.
set -eu
export LC_ALL=C
unset CDPATH
goal=${1:-all}
cd "$(dirname "$0")"
PATH=$(cd ../.. && pwd)/bin:$PATH
say() { printf 'lab: %s\n' "$*" >&2; }
column=${column:-x} slope=${slope:-0} m=${m:-1}
[ -n "${K-}" ] && [ -n "${R-}" ] || { say 'say what rolled: K=0.5 R=0.04'; exit 2; }
case $column in
  x) route=position ;;
  v) route=velocity ;;
  *) say "column=$column: x or v"; exit 2 ;;
esac
records=${records:-records}
set --
for file in "$records"/*; do
  case $file in
    *.[cC][sS][vV] | *.[tT][sS][vV] | *.[tT][xX][tT])
      [ "${file##*/}" = truth.txt ] || set -- "$@" "$file" ;;
    *) [ ! -f "$file" ] || say "left out, since it ends in none of .csv, .tsv, .txt: ${file##*/}" ;;
  esac
done
[ $# -gt 0 ] || { say "no runs in '$records': say records=/PATH/OF/THE/FOLDER"; exit 2; }

rm -rf results
mkdir results
roll() { with_use smooth --coast -c "$column" -w 1 -- "$@"; }
# with_use COMMAND OPTION... -- FILE...: the command with a --use for each word of use.
with_use() {
  command=$1
  shift
  set -f  # t=2[ms] is no pattern
  for word in ${use-}; do set -- --use "$word" "$@"; done
  set +f
  "$command" "$@"
}
fit() { fitpower --digits 6 --route $route -K "$K" -R "$R" "$@"; }
# Of a list, K or R, the value of run number $2.
of_run() { printf '%s\n' "$1" | awk -F, -v i="$2" '{ print (NF > 1 ? $i : $1) }'; }
velocity() {
  if [ "$column" = x ]; then roll "$1" | differentiate -c x -M savgol -w 21
  else roll "$1" | smooth -c v -M savgol -w 21; fi
}

# Several runs have the names of their files.
{ [ $# -gt 1 ] || printf '## run %s\n' "$(printf %s "${1##*/}" | tr '[:cntrl:]' '?')"
  roll "$@"; } >results/rolls
if [ "$slope" = fit ]; then
  fit --slope fit results/rolls >results/slope.txt
  slope=$(awk -F '\t' '/^# / { for (i = 1; i <= NF; i++) if ($i == "slope") s = i; next }
    !/^#/ { print $s }' results/slope.txt)
fi
fit --slope "$slope" --each results/rolls >results/table.txt
if [ $# -gt 1 ]; then
  quiet=  # check tells of runs that disagree
  [ "$goal" = all ] || quiet=-q
  fitpower $quiet --digits 6 --route fits -K "$K" -R "$R" results/table.txt >results/joint.txt
  cat results/joint.txt
else
  cat results/table.txt
fi
if command -v gnuplot >/dev/null; then
  with_use ../figures/fig4.sh -c "$column" -K "$K" -R "$R" --slope "$slope" -- "$@" >results/fig4.svg
fi
[ "$goal" = check ] || exit 0

# One law for all, a law a v^b for each run, and the energy that it dissipates, within 5 %. The
# speeds of a sensor are not asked for the law: each was made of several positions, so their noise is
# not white, and the check of the residuals would blame the law for it.
failed=0
[ $# -lt 2 ] || fitpower -q --check --route fits -K "$K" -R "$R" results/table.txt >/dev/null ||
  { say 'the runs do not have one law'; failed=1; }
[ "$column" = v ] || fit -q --check --each --slope "$slope" results/rolls >/dev/null ||
  { say 'the positions are not those of a law a v^b'; failed=1; }
i=0
for file; do
  i=$((i + 1))
  law=$(awk -F '\t' -v i=$i '!/^#/ && ++n == i { print "-a " $1 " -b " $3 }' results/table.txt)
  # shellcheck disable=SC2086  # two options and their numbers
  velocity "$file" 2>/dev/null | energy-ledger -m "$m" -K "$(of_run "$K" $i)" \
    -R "$(of_run "$R" $i)" --slope "$slope" $law --summary --check 0.05 >>results/energy.txt ||
    { say "the energy of run $i does not balance: ${file##*/}"; failed=1; }
done
exit $failed
