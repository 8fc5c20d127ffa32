#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# samples/law.sh: the law of a row and its bands as columns, against 20000 draws of a and b from the
# errors of the row and their correlation; and what is no row is refused.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
law=samples/law.sh
printf '# a[m]\tsigma_a[m]\tb\tsigma_b\tcorr\trms\tn\tv0[m/s]\n0.002\t4e-05\t0.2\t0.01\t0.8\t1\t50\t0.5\n' >"$scratch/row"
"$law" -n 3 "$scratch/row" >"$scratch/law" || complain "law.sh: exit $?"
awk '
  function normal() { return sqrt(-2 * log(1 - rand())) * cos(8 * atan2(1, 1) * rand()) }
  BEGIN { srand(1); N = 20000
    for (i = 1; i <= N; i++) { p = normal(); q = 0.8 * p + 0.6 * normal()
      a[i] = 0.002 * exp(0.02 * p); b[i] = 0.2 + 0.01 * q } }
  /^# v\[m\/s\]\tD\[m\]\tD_low68\[m\]\tD_high68\[m\]\tD_low95\[m\]\tD_high95\[m\]$/ { names = 1; next }
  { rows++; v = $1; if (($2 / (0.002 * v^0.2) - 1)^2 > 1e-10) { print "D at " v " is " $2; bad = 1 }
    near = far = 0
    for (i = 1; i <= N; i++) { D = a[i] * v^b[i]; near += D > $3 && D < $4; far += D > $5 && D < $6 }
    if ((near / N - 0.6827)^2 > 1e-4 || (far / N - 0.95)^2 > 3e-5) {
      print "at " v " the bands hold " near / N " and " far / N; bad = 1 } }
  rows == 3 && v != 0.5 { print "the last v is " v; bad = 1 }
  END { exit bad || !names || rows != 3 }' "$scratch/law" || wrong=1
# Another law, which is linear in its coefficients: sigma_D = sqrt(C00 + 2 C02 v^2 + C22 v^4).
printf '# d0[m]\tsigma_d0[m]\td2[s^2/m]\tsigma_d2[s^2/m]\tcorr_d0_d2\n1e-3\t2e-5\t4e-4\t1e-4\t-0.7\n' |
  "$law" -f 0.1 -t 2 -n 20 | awk -F '\t' '
    /^#/ { next }
    { D = 1e-3 + 4e-4 * $1^2; s = sqrt(4e-10 - 2.8e-9 * $1^2 + 1e-8 * $1^4); rows++
      for (i = 2; i <= 6; i++) {
        want = i == 2 ? D : D * exp((i % 2 ? -1 : 1) * (i < 5 ? 1 : 1.96) * s / D)
        if (($i / want - 1)^2 > 1e-10) { print "d0 + d2 v^2 at " $1 ": " $i " for " want; bad = 1 } } }
    END { exit bad || rows != 20 }' || wrong=1
# Rows under several headers, each under its own: the curves of both files, one behind the other. And
# the lower limit is the lower one where D < 0.
printf '# d0[m]\tsigma_d0[m]\td2[s^2/m]\tsigma_d2[s^2/m]\tcorr_d0_d2\n-1e-3\t2e-5\t4e-4\t1e-5\t0\n' >"$scratch/other"
{ "$law" -t 0.4 -n 3 "$scratch/row"; echo; "$law" -t 0.4 -n 3 "$scratch/other"; } >"$scratch/each"
cat "$scratch/row" "$scratch/other" | "$law" -t 0.4 -n 3 | cmp - "$scratch/each" ||
  complain 'two headers: another law than that of each file'
"$law" -t 0.4 -n 3 "$scratch/other" | awk '!/^#/ { n++; if (!($5 < $3 && $3 < $2 && $2 < $4 && $4 < $6)) exit 1 }
  END { exit n != 3 }' || complain 'the limits of a D below 0 are not in order'
"$law" </dev/null 2>"$scratch/said" && complain 'law.sh: no row passes'
grep -q 'no row' "$scratch/said" || complain "law.sh says: $(cat "$scratch/said")"
echo '1 2' | "$law" 2>/dev/null && complain 'law.sh: no names pass'
"$law" -f 2 -t 1 "$scratch/row" 2>/dev/null && complain 'law.sh: from 2 to 1 passes'
exit $wrong
