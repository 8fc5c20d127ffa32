#!/bin/bash
# fit.sh RECORD: the row that fitpower finds for one record, under its names, with the name of the
# record in front. K and R are those of make.sh. In the name, what a field of a table cannot hold (a
# tab, a line end, a quote) is written as ?, and a name that begins with # is quoted.
set -euo pipefail
export LC_ALL=C
unset CDPATH
row=$(smooth -q --coast -c x -w 1 -- "$1" | fitpower -q --route position -K 0.5 -R 0.04)
record=${1##*/} row=$row awk 'BEGIN {
  name = ENVIRON["record"]
  sub(/\.csv$/, "", name)
  gsub(/[[:cntrl:]"]/, "?", name)
  if (name ~ /^#/) name = "\"" name "\""
  n = split(ENVIRON["row"], line, "\n")
  for (i = 1; i <= n; i++) {
    if (line[i] ~ /^# /) print "# record\t" substr(line[i], 3)
    else if (line[i] !~ /^#/) print name "\t" line[i]
  }
}'
