#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# law.sh [-f FROM] [-t TO] [-n N] [ROW]: the law of a row of fitpower, from a file or from standard
# input, as columns: N velocities (50) from FROM to TO in m/s, D, and the limits of its 68 % and of its
# 95 % band. TO is v0 of the row, or 0.5 where it has none, and FROM a 25th of TO. Of several rows each
# makes a run.
#
# The band is that of ln D, at 1 and 1.96 standard uncertainties: sigma_D is that of a function of
# the numbers of the row, which are correlated (GUM, Eq. 16), with central differences of D by each
# number. It needs an awk with exp.
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
wrong() { echo "law.sh: $1" >&2; exit 2; }
bin=$(cd "$(dirname "$0")/.." && pwd)/bin
PATH=$bin:$PATH

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
  printf '%s\n' "$1" "$2" | awk -F '\t' -v OFS='\t' -v law="$scratch/law" -v grid="$scratch/grid" '
    # D at the velocities of the grid under the present row, number i of it moved by so many sigma
    function shifts(D, i, by,   n, value, command, line, cell) {
      value = $i
      if (by) $i = sprintf("%.17g", value + by * sigma(i))
      print header "\n" $0 >law
      close(law)
      $i = value
      command = "energy-ledger -q --law " law " -m 1 -K 0 -R 1 --columns D " grid
      while ((command | getline line) > 0)
        if (line !~ /^#/) { split(line, cell, "\t"); v[++n] = cell[2]; D[n] = cell[3] }
      close(command)
      return n
    }
    function sigma(i) { return ("sigma_" name[i]) in column ? $column["sigma_" name[i]] : 0 }
    function correlation(i, j,   both) {
      both = name[i] == "a" && name[j] == "b" ? "corr" : "corr_" name[i] "_" name[j]
      return both in column ? $column[both] : 0
    }
    NR == 1 {
      header = $0
      for (i = 1; i <= NF; i++) { name[i] = $i; gsub(/^# |\[.*/, "", name[i]); column[name[i]] = i }
      next
    }
    {
      n = shifts(D, 1, 0)
      for (i = 1; i <= NF; i++) if (sigma(i)) {
        known = 1
        shifts(above, i, 1e-3); shifts(below, i, -1e-3)
        for (k = 1; k <= n; k++) part[i, k] = (above[k] - below[k]) / 2e-3
      }
      if (!n || !known) exit 1
      print "# v[m/s]\tD[m]\tD_low68[m]\tD_high68[m]\tD_low95[m]\tD_high95[m]"
      for (k = 1; k <= n; k++) {
        variance = 0
        for (j = 1; j <= NF; j++) if (sigma(j)) {
          variance += part[j, k]^2
          for (i = 1; i < j; i++)
            if (sigma(i)) variance += 2 * correlation(i, j) * part[i, k] * part[j, k]
        }
        s = sqrt(variance > 0 ? variance : 0) / D[k]
        printf "%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n", v[k], D[k], D[k] * exp(-s), D[k] * exp(s),
          D[k] * exp(-1.96 * s), D[k] * exp(1.96 * s)
      }
    }' || wrong 'no row of fitpower with its uncertainties'
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat -- "${1:--}" >"$scratch/rows"
header=$(grep '^# ' "$scratch/rows" | tail -n 1) || wrong 'no row of fitpower'
rows=0
while IFS= read -r row; do
  case $row in '' | '#'* | $'\t'*) continue ;; esac  # a run that fitpower could not fit is blank
  [ $((rows += 1)) = 1 ] || echo
  law "$header" "$row"
done <"$scratch/rows"
[ $rows -gt 0 ] || wrong 'no row of fitpower'
