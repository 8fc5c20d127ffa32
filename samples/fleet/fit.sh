#!/usr/bin/env bash
# fit.sh [-K K] [-R R] [-c x|v] RECORD: the row that fitpower finds for one record, under its names,
# with the name of the record in front. K (0.5) is the shape factor, R (0.04) the radius in metres;
# x (the default) fits the positions of the record, v its velocities. In the name, what a field of a
# table cannot hold (a tab, a line end, a quote) is written as ?; a name that begins with # is
# quoted.
set -euo pipefail
export LC_ALL=C
unset CDPATH
K=0.5 R=0.04 column=x
while getopts K:R:c: option; do
  case $option in
    K) K=$OPTARG ;;
    R) R=$OPTARG ;;
    c) column=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# = 1 ] || { echo "fit.sh: one record, not $#" >&2; exit 2; }
case $column in
  x) route=position ;;
  v) route=velocity ;;
  *) echo "fit.sh: -c $column: x or v" >&2; exit 2 ;;
esac
# The tools of this source, or those on the PATH.
PATH=$(cd "$(dirname "$0")/../.." && pwd)/bin:$PATH

row=$(smooth -q --coast -c $column -w 1 -- "$1" |
  fitpower -q --digits 6 --route $route -K "$K" -R "$R")
record=${1##*/} row=$row awk 'BEGIN {
  name = ENVIRON["record"]
  sub(/\.[^.]*$/, "", name)
  gsub(/[[:cntrl:]"]/, "?", name)
  if (name ~ /^#/) name = "\"" name "\""
  n = split(ENVIRON["row"], line, "\n")
  for (i = 1; i <= n; i++) {
    if (line[i] ~ /^# /) print "# record\t" substr(line[i], 3)
    else if (line[i] !~ /^#/) print name "\t" line[i]
  }
}'
