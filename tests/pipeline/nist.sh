#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# NIST's certified data sets (StRD) through the tools: the mean of NumAcc1 to 4, Lew and Lottery by
# the window that holds them all, DanWood's power law and Bennett5's trajectory.
set -eu
export LC_ALL=C
unset CDPATH
data=${NIST_DATA:-}
[ -r "$data/NumAcc4.dat" ] ||
  { echo "skipped: NIST_DATA names no folder with the data files of NIST; see tests/recordings.md";
    exit 77; }
mean() {  # SET MEAN, as certified, to 15 digits: of the middle row of an odd number of rows; an even number gets the mean as one more
  local numbers got
  numbers=$(awk -v mean="$2" 'data && NF == 1 { print n++, $1 } /^-+ *$/ { data = 1 }
    END { if (n % 2 == 0) print n++, mean }' "$data/$1.dat")
  got=$(smooth -w 100001 <<<"$numbers" |
    awk -v n="$(wc -l <<<"$numbers")" '!/^#/ && ++row == int((n + 1) / 2) { print $2 }')
  awk -v got="$got" -v mean="$2" '
    BEGIN { off = got / mean - 1; exit !(got != "" && off^2 <= 1e-30) }' ||
        { echo "$1: the mean is $got, certified $2"; exit 1; }
}
mean NumAcc1 10000002
mean NumAcc2 1.2
mean NumAcc3 1000000.2
mean NumAcc4 10000000.2
mean Lew -177.435
mean Lottery 518.958715596330
awk 'NR > 60 && NF == 2 { print $2, $1 }' "$data/DanWood.dat" | fitpower --route shift |
  awk 'function off(x, c) { return (x / c - 1)^2 > 1e-20 }
    !/^#/ && (off($1, 7.6886226176E-01) || off($2, 1.8281973860E-02) || off($3, 3.8604055871E+00) || off($4, 5.1726610913E-02)) { print "DanWood:", $0; exit 1 }'
# Bennett5, y = b1 (b2 + x)^(-1/b3), is v(t) with g = 1, K = 0, R = 1: a = 1 / (b3 |b1|^b3), b = 1 +
# b3. Its errors are not compared: the residuals are correlated, which NIST's do not count.
awk 'BEGIN { print "# t v" } NR > 60 && NF == 2 { print $2, $1 }' "$data/Bennett5.dat" |
  fitpower --route velocity -K 0 -R 1 -g 1 |
  awk 'function off(x, c) { return !((x / c - 1)^2 < 1e-18) }
    !/^#/ {
      rows = 1; b3 = 0.9321848319330336
      if (off($3, 1 + b3) || off($1, 1 / (b3 * 2523.505804303253 ^ b3))) bad = 1;
      if (bad) print "Bennett5:", $0 }
    END { exit bad || !rows }'
