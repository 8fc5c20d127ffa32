#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# law.sh [-f FROM] [-t TO] [-n N] [ROW]: prints the law of a row of fitpower as columns: v, D, and the
# limits of the 68 % and the 95 % band of D. ROW is a file; without it standard input is read. There are
# N velocities (50) from FROM to TO in m/s. TO is v0 of the row (else 0.5), FROM a 25th of TO. Each of
# several rows makes a run.
#
# The band is that of ln D, at 1 and 1.96 standard uncertainties. energy-ledger computes sigma_D from
# the uncertainties of the row and their correlations. The script needs an awk with exp.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
n=50
options '-f -t -n' "$@"
from=$f to=$t N=$n
set -- ${operands[@]+"${operands[@]}"}
[ $# -le 1 ] || wrong "one file, not $#"
[ "${1--}" = - ] || [ -r "$1" ] || wrong "$1 cannot be read"
is_count "$N" && [ "$N" -ge 2 ] || wrong "-n $N: a whole number, 2 or more"
for limit in "$from" "$to"; do
  [ -z "$limit" ] || is_number "$limit" || wrong "$limit is not a number"
done

# The velocities of a row with their law, which is not that of a body: K, R and m do not count.
law() {  # HEADER ROW
  printf '%s\n' "$1" "$2" | awk -F '\t' -v from="$from" -v to="$to" -v N="$N" '
    NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^(# )?v0\[m\/s\]$/) v0 = i; next }
    {
      last = to != "" ? to : v0 ? $v0 : 0.5
      if (last < 0) last = -last
      first = from != "" ? from : last / 25
      if (!(first > 0 && last > first && N >= 2)) exit 2
      print "# t[s]\tv[m/s]"
      for (i = 0; i < N; i++) printf "%d\t%.17g\n", i, first + (last - first) * i / (N - 1)
    }' >"$scratch/grid" || wrong 'needs 0 < FROM < TO, and N of 2 or more'
  printf '%s\n' "$1" "$2" | energy-ledger -q --law - -m 1 -K 0 -R 1 --columns D,sigma_D "$scratch/grid" |
    awk -F '\t' '
      /^##/ { next }
      /^#/ { print "# v[m/s]\tD[m]\tD_low68[m]\tD_high68[m]\tD_low95[m]\tD_high95[m]"; next }
      { s = $4 / $3
        printf "%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n", $2, $3, $3 * exp(-s), $3 * exp(s),
          $3 * exp(-1.96 * s), $3 * exp(1.96 * s) }'
}

make_scratch
cat -- "${1:--}" >"$scratch/rows"
header='' rows=0
while IFS= read -r row; do
  case $row in
    '# '*) header=$row; continue ;;  # of the rows below it
    '' | '#'* | $'\t'*) continue ;;  # a run that fitpower could not fit is blank
  esac
  [ "$header" ] || wrong 'no row of fitpower'
  [ $((rows += 1)) = 1 ] || echo
  law "$header" "$row"
done <"$scratch/rows"
[ $rows -gt 0 ] || wrong 'no row of fitpower'
