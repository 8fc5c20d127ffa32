#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fit.sh -K K -R R [-c x|v] RUN: the row that fitpower finds for one run, under its names, with the
# name of the run in the column run. K is the shape factor, R the radius in metres; x (the default)
# fits the positions of the run, v its velocities. What the tools tell goes to standard error, a line
# each with the name in front. In the name, control characters are written as ?.
set -euo pipefail
export LC_ALL=C
unset CDPATH
K='' R='' column=x
while getopts K:R:c: option; do
  case $option in
    K) K=$OPTARG ;;
    R) R=$OPTARG ;;
    c) column=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ "$K" ] && [ "$R" ] || { echo "fit.sh: say what rolled: -K 0.5 -R 0.04" >&2; exit 2; }
[ $# = 1 ] || { echo "fit.sh: one run, not $#" >&2; exit 2; }
case $column in
  x) route=position ;;
  v) route=velocity ;;
  *) echo "fit.sh: -c $column: x or v" >&2; exit 2 ;;
esac
# The tools of this source, or those on the PATH.
PATH=$(cd "$(dirname "$0")/../.." && pwd)/bin:$PATH

name=${1##*/} && name=${name//[[:cntrl:]]/?}
fit() {
  { printf '## run %s\n' "$name"; smooth --coast -c $column -w 1 -- "$1"; } |
    fitpower --each --digits 6 --route $route -K "$K" -R "$R"
}
status=0
exec 3>&1
said=$(fit "$1" 2>&1 >&3) || status=$?
while IFS= read -r line; do
  [ -z "$line" ] || printf '%s: %s\n' "$name" "$line" >&2
done <<<"$said"
exit $status
