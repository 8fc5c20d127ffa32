#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# simulate against the rolls of tests/reference: v within 1e-12 of the largest speed of a roll, x
# within 1e-12 of its way, time and way of the stop within 1e-12 of themselves.
#
#   tests/pipeline/reference.sh           complains
#   tests/pipeline/reference.sh table     prints the largest error of each kind of roll instead
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
rolls=tests/reference/rolls.tsv

roll=0
while IFS=$'\t' read -r A K R g S a b table v0; do
  awk -F '\t' -v roll="$A $K $R $g $S $a $b $table $v0" -v OFS='\t' '
    roll == $2 " " $3 " " $4 " " $5 " " $6 " " $7 " " $8 " " $9 " " $10 {
      print $11, $12, $13, $22, $23, $1 }' "$rolls" >"$scratch/want"
  options=(-K "$K" -R "$R" -g "$g" --slope "$S" --v0 "$v0")
  if [ "$table" = - ]; then
    options+=(-a "$a" -b "$b")
  else
    tr ':,' '\t\n' <<<"$table" >"$scratch/law"
    options+=(--law "$scratch/law")
  fi
  [ "$A" = 1 ] || options+=(--exact)
  { echo '# t'; cut -f 1 "$scratch/want"; } |
    simulate "${options[@]}" --at - --columns v,x 2>"$scratch/err" | grep -v '^#' >"$scratch/have"
  if [ "$(tail -n 1 "$scratch/want" | cut -f 2)" = 0.0 ]; then  # it stops, and stays
    simulate "${options[@]}" --dt 1e200 --columns t,x 2>>"$scratch/err" | tail -n 1 >"$scratch/stop"
  else
    : >"$scratch/stop"
  fi
  # KIND, error of v, x, t_stop, x_stop, and the roll
  awk -F '\t' -v v0="$v0" -v roll="${options[*]} $(head -n 1 "$scratch/err")" '
    function size(x) { return x < 0 ? -x : x }
    function off(have, want, unit) { return have == "" ? 1 : size(have - want) / unit }
    function larger(x, y) { return size(x) > y ? size(x) : y }
    FILENAME ~ /have$/ { have_v[FNR] = $1; have_x[FNR] = $2; next }
    FILENAME ~ /stop$/ { t_stop = $1; x_stop = $2; stops = 1; next }
    { t[++n] = $1; v[n] = $2; x[n] = $3; T = $4; X = $5; kind[n] = $6 }
    END {
      top = v0
      for (i = 1; i <= n; ++i) { top = larger(v[i], top); way = larger(x[i], way) }
      if (X != "-") way = larger(X, way)
      for (i = 1; i <= n; ++i)
        print kind[i], off(have_v[i], v[i], top), off(have_x[i], x[i], way),
          stops && i == n ? off(t_stop, T, T) : 0, stops && i == n ? off(x_stop, X, X) : 0,
          "t = " t[i] ": v " have_v[i] " for " v[i] ", x " have_x[i] " for " x[i] \
          (stops && i == n ? ", stop " t_stop " for " T ", " x_stop " for " X : "") ": simulate " roll
    }' OFS='\t' "$scratch/have" "$scratch/stop" "$scratch/want"
  roll=$((roll + 1))
done < <(tail -n +2 "$rolls" | cut -f 2-10 | uniq) >"$scratch/errors"

awk -F '\t' -v table="${1-}" '
  {
    for (i = 2; i <= 5; ++i) if ($i > worst[$1, i]) worst[$1, i] = $i
    kinds[$1]++
    wrong = $2 > 1e-12 || $3 > 1e-12 || $4 > 1e-12 || $5 > 1e-12
    if (table == "" && wrong) { print $1 ": " $6; bad = 1 }
  }
  END {
    if (NR < 400) { print "only " NR " instants were compared"; bad = 1 }
    if (table != "") {
      printf "%-16s %8s %8s %8s %8s %8s\n", "kind", "instants", "v/v0", "x/way", "t_stop", "x_stop"
      for (k in kinds) printf "%-16s %8d %8.1e %8.1e %8.1e %8.1e\n", k, kinds[k], worst[k, 2], worst[k, 3], worst[k, 4], worst[k, 5]
    }
    exit bad
  }' "$scratch/errors"
