#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every equation of the paper from what the tools print, and every symbol of rolling-motion(7) from
# the command that its table names. Prints the table of the equations with the largest relative
# difference of their two sides over the run; 1e-12 and more is a failure.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
scene=samples/CR.toml

# The equations, in awk: the name, the left side, the right side. S is the slope, m R K g the body.
equations='1|v|omega*R
2, 3|L|K*R*p
2, E_rot|E_rot|0.5*(L/omega)*omega^2
4|m*a|F_H-m*g*sin_
3, 5|K*R*m*a|tau_N+tau_H
6|tau_H|-A*R*F_H
7|tau_N|-D*F_N
7, F_N|F_N|m*g*cos_
8|A|sqrt(1-D^2/R^2)
9, level|F_H|-D*F_N/((K+A)*R)
10, level|tau_N/tau_H|-(K/A+1)
12|a|-g*(D*cos_+A*R*sin_)/((K+A)*R)
16|vP_H|(1-A)*v
17|I_E1|-(1-A)*v*F_H
18, level|P_T1|A*v*D*m*g/(R*(K+A))
18, used|P_R1|-P_T1
18, power|P_T1|(v-vP_H)*-F_H
19|P_R2|v/R*D*F_N
19, used|P_T2|-P_R2
20|vP_V|-D/R*v
21|I_E2|D/R*v*F_N
P_T3|P_T3|-vP_H*F_H
P_T4|P_T4|-vP_V*F_N
22|I_E1+I_E2|-(K+1)*m*v*a-m*g*sin_*v
22, P_diss|P_diss|P_T3+P_T4
E_trans|E_trans|m*v^2/2
entropy|Pi_S*293|P_diss
entropy, mat|I_S|Pi_S
2|J|K*m*R^2
14, body|P_T1|-omega*I_LH
14, leaving|P_R2|omega*I_LN
15, with p_x|I_E1|vP_H*I_pH
15, with p_y|I_E2|vP_V*I_pN
4, out|I_pH|-F_H
5, out|I_LH+I_LN|-(tau_N+tau_H)
both forces|F_S^2|F_N^2+F_H^2
weight|F_G|m*g
E|E|E_trans+E_rot
entropy, all|S*293|E_diss
E_tr|E_tr|-E_diss'
columns=omega,p,L,A,F_N,F_H,tau_N,tau_H,vP_H,vP_V,E_trans,E_rot,I_E1,I_E2,P_T1,P_R1,P_R2,P_T2
columns=$columns,P_T3,P_T4,P_diss,E_diss,W_g,Pi_S,I_S,S,J,F_S,F_G,I_pH,I_pN,I_LH,I_LN,E,E_tr

# An awk program of the equations. Differences are relative to the larger side; 1 - A, which is all
# of I_E1, is small beside 1, so the sides of 16 and 17 are compared beside v and v F_H.
program() {
  local name left right
  while IFS='|' read -r name left right; do
    [[ $name != *level* || $1 = 0 ]] || continue
    echo "compare(\"$name\", \"$left = $right\", $left, $right);"
  done <<<"$equations"
}
for slope in 0 0.02 -0.003; do
  # On a level mat simulate makes the acceleration of the shift; on a slope, shift-from-accel makes
  # the shift of an acceleration.
  if [ "$slope" = 0 ]; then
    simulate --scene "$scene" --exact --columns t,v,a,D
  else
    awk 'BEGIN { print "# t[s]\tv[m/s]\ta[m/s^2]"; for (i = 0; i <= 20; i++) printf "%g\t%g\t%g\n", i / 100, 0.5 - i / 50, i / 77 - 0.4 }' |
      shift-from-accel --exact --slope "$slope" -K 0.5 -R 0.04
  fi | energy-ledger --exact --slope "$slope" -m 1.375 -K 0.5 -R 0.04 --temperature 293 \
    --columns "$columns" >"$scratch/all"
  cat >"$scratch/program" <<AWK
function abs(x) { return x < 0 ? -x : x }
function compare(name, text, x, y,   size) {
  size = abs(x) > abs(y) ? abs(x) : abs(y)
  if (name == "16" && size < v) size = v
  if ((name == "17" || name == "15, with p_x") && size < v * abs(F_H)) size = v * abs(F_H)
  if (name == "4" || name ~ /^(3, 5|5, out)$/ || name == "22") size += m * g * abs(sin_)
  if (!(name in worst)) { order[++n] = name; said[name] = text; worst[name] = 0 }
  if (size > 0 && abs(x - y) / size > worst[name]) worst[name] = abs(x - y) / size
}
/^##/ { next }
/^#/ {
  sub(/^# */, "")
  fields = split(\$0, names, "\t")
  for (i = 1; i <= fields; i++) { sub(/\[.*/, "", names[i]); at[names[i]] = i }
  next
}
{
  m = 1.375; R = 0.04; K = 0.5; g = 9.81; S = $slope
  cos_ = 1 / sqrt(1 + S^2); sin_ = S * cos_
  v = \$at["v"]; a = \$at["a"]; D = \$at["D"]
$(tr , '\n' <<<"$columns" | sed 's/.*/  & = $at["&"]/')
  if (v <= 0) next
  $(program "$slope")
}
END {
  for (i = 1; i <= n; i++) {
    bad = !(worst[order[i]] < 1e-12)
    printf "%-12s %-52s %8.1e%s\n", order[i], said[order[i]], worst[order[i]], bad ? "  WRONG" : ""
    failed += bad
  }
  exit !(n > 20 && failed == 0)
}
AWK
  echo "slope $slope"
  awk -f "$scratch/program" "$scratch/all" || wrong=1
done

# Eq. 11 and the exact root, back from the acceleration; 13 against the printed form; 23.
near() { awk -v x="$2" -v y="$3" -v e="$4" 'BEGIN { d = x / y - 1; exit !(d < e && d > -e) }' ||
  { echo "Eq. $1: $2 is not $3" && wrong=1; }; }
last() { tail -n 1 | cut -f "$1"; }
row="0.5 0.5 -0.26"
near 11 "$(echo "$row" | shift-from-accel -K 0.5 -R 0.04 | last 4)" \
  "$(awk 'BEGIN { printf "%.17g", 1.5 * 0.04 * 0.26 / 9.81 }')" 1e-14
near 13 "$(printf 't\n0.7\n' | simulate --scene "$scene" --at - --columns v | last 1)" "$(awk 'BEGIN {
  b = 0.215; printf "%.17g", (0.5^(1 - b) - (1 - b) * 1.87e-3 * 9.81 / (1.5 * 0.04) * 0.7)^(1 / (1 - b)) }')" 1e-12
near 23 "$(simulate --scene "$scene" | energy-ledger --scene "$scene" --columns E_diss | last 6)" \
  "$(awk 'BEGIN { printf "%.17g", 0.5 * 1.5 * 1.375 * 0.25 }')" 1e-6

# The table of symbols: SYMBOL, UNIT, MEANING and `TOOL COLUMN` or a column of energy-ledger, two
# blanks or more apart.
simulate --scene "$scene" >"$scratch/roll"
symbols=0
while read -r tool column; do
  symbols=$((symbols + 1))
  case $tool in
    simulate) simulate --scene "$scene" --columns "$column" ;;
    ledger) energy-ledger --scene "$scene" --temperature 293 --columns "$column" "$scratch/roll" ;;
    differentiate) differentiate --use v=v "$scratch/roll" ;;
    shift-from-accel) shift-from-accel --scene "$scene" "$scratch/roll" ;;
    fitpower) fitpower -q "$scratch/roll" ;;
    *) echo "$tool prints nothing" && false ;;
  esac >"$scratch/out" && grep '^#' "$scratch/out" | tail -n 1 | tr '\t' '\n' | sed 's/^# //; s/\[.*//' |
    grep -qx "$column" || { echo "rolling-motion(7): $tool does not print $column" && wrong=1; }
done < <(sed -n '/^\.Ss Symbols/,/^\.Ed/p' man/rolling-motion.7 |
  sed -nE '/meaning  *from$/d; s/^.*  ([A-Za-z][A-Za-z0-9_]*)$/\1/; s/^[A-Z_a-z]*$/ledger &/
    s/^.*  ([a-z-]+ [A-Za-z0-9_]+)$/\1/; /^[a-z-]+ [A-Za-z0-9_]+$/p')
[ "$symbols" -ge 30 ] ||
  { echo "only $symbols symbols in the table of rolling-motion(7)" && wrong=1; }
exit $wrong
