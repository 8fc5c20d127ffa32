#!/bin/bash
# NIST's certified data sets (StRD) through the tools: the mean of NumAcc2 to 4 by the window that holds them all, DanWood's power law.
set -eu
data=${NIST_DATA:-}
[ -r "$data/NumAcc4.dat" ] || { echo "skipped: NIST_DATA names no reference data"; exit 77; }
mean() {  # SET MEAN, certified exactly; all have 1001 numbers, the middle row sees them all
  local got
  got=$(awk 'data { print n++, $1 } /^-+ *$/ { data = 1 }' "$data/$1.dat" | smooth -w 1001 | awk '!/^#/ && ++n == 501 { print $2 }')
  [ "$got" = "$2" ] || { echo "$1: the mean is $got, certified $2"; exit 1; }
}
mean NumAcc2 1.2
mean NumAcc3 1000000.2
mean NumAcc4 10000000.2
awk 'NR > 60 && NF == 2 { print $2, $1 }' "$data/DanWood.dat" | fitpower --route shift |
  awk 'function off(x, c) { return (x / c - 1)^2 > 1e-20 }
    !/^#/ && (off($1, 7.6886226176E-01) || off($2, 1.8281973860E-02) || off($3, 3.8604055871E+00) || off($4, 5.1726610913E-02)) { print "DanWood:", $0; exit 1 }'
