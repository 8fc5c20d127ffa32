#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# law.sh [-f FROM] [-t TO] [-n N] [ROW]: the law D = a v^b of a row of fitpower, from a file or from
# standard input, as columns: N velocities (50) from FROM to TO in m/s, D, and the limits of its 68 %
# and of its 95 % band. TO is v0 of the row, or 0.5 where it has none, and FROM a 25th of TO. Of
# several rows each makes a run.
#
# It needs an awk with exp, log and sqrt.
#
# The band is that of ln D = ln a + b ln v, at 1 and 1.96 standard uncertainties, from sigma_a,
# sigma_b and their correlation.
set -euo pipefail
export LC_ALL=C
unset CDPATH
from='' to='' N=50
while getopts hf:t:n: option; do
  case $option in
    f) from=$OPTARG ;;
    t) to=$OPTARG ;;
    n) N=$OPTARG ;;
    h) sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$0"; exit ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -le 1 ] || { echo "law.sh: one file, not $#" >&2; exit 2; }
awk -F '\t' -v from="$from" -v to="$to" -v N="$N" '
  function wrong(what) { print "law.sh: " what >"/dev/stderr"; failed = 2; exit 2 }
  function print_row(v,  D, sigma) {
    D = a * v^b
    sigma = sqrt((s / a)^2 + (t * log(v))^2 + 2 * corr * s / a * t * log(v))
    printf "%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n", v, D, D * exp(-sigma), D * exp(sigma),
      D * exp(-1.96 * sigma), D * exp(1.96 * sigma)
  }
  /^##/ { next }
  /^# / {
    sub(/^# /, "")
    for (i = 1; i <= NF; i++) { name = $i; sub(/\[.*/, "", name); column[name] = i }
    next
  }
  /^$/ { next }
  {
    if (!("a" in column && "sigma_a" in column && "b" in column && "sigma_b" in column &&
      "corr" in column)) wrong("no columns a, sigma_a, b, sigma_b and corr: is this a row of fitpower?")
    a = $column["a"]; s = $column["sigma_a"]; b = $column["b"]; t = $column["sigma_b"]
    if (a == "") next  # a run that fitpower could not fit
    corr = $column["corr"]
    last = to != "" ? to : "v0" in column ? $column["v0"] : 0.5
    if (last < 0) last = -last
    first = from != "" ? from : last / 25
    if (!(first > 0 && last > first && N >= 2)) wrong("needs 0 < FROM < TO, and N of 2 or more")
    if (!rows++) print "# v[m/s]\tD[m]\tD_low68[m]\tD_high68[m]\tD_low95[m]\tD_high95[m]"
    else print ""
    for (i = 0; i < N; i++) print_row(first + (last - first) * i / (N - 1))
  }
  END { if (!failed && !rows) wrong("no row of fitpower"); exit failed }' "${1:--}"
