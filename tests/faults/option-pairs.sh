#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No option passes without effect: alone and beside each other one it is refused, or it changes what
# is printed or the exit status. Of the pairs a tenth is tried, all with LONG=1.
. "$(dirname "$0")/tools"
samples=$PWD/samples
cd "$scratch" || exit 2

# Two runs with a history, and a missing reading behind the last; the same with a D missing.
smooth -q --coast -w 7 "$samples/CR.csv" "$samples/SR.csv" | differentiate |
  shift-from-accel -K 0.6 -R 0.05 |
  sed 's/\[[^]]*\]//g' >roll
printf '99\tNaN\tNaN\tNaN\tNaN\n' >>roll
awk -v FS='\t' -v OFS='\t' '/^#/ || !NF || /NaN/ { print; next } { $2 *= 1.0000123; if ($1 == 3.2) $5 = "NaN"; print }' roll >gap
printf 'a b v0 slope\n2e-3 0.3 0.45 3e-4\n' >row
printf 'a b v0\n2e-3 0.3 0.45\n' >law
printf 'a b x0 run\n2e-3 0.3 0.4 one\n2e-3 0.3 0.5 two\n' >rows
printf '0.001 5e-4\n0.1 1e-3\n0.3 1.4e-3\n0.8 1.7e-3\n' >table
printf 't\n0\n0.3\n1\n' >moments
printf 'gravity = 9.8\nslope = 1e-4\n' >scene

# Each tool with what it needs, and its other options, with values that are not the default.
# -q and -u say how something is printed. A temperature describes the mat, as a scene does: it may
# be given whatever is printed. The error of a solver is below the resolution of a sensor.
excused='--sensor pasco --method rkf45|--sensor pasco --law rows --run two|--use D=x --scene scene'
scene='-g 9.7|--slope 0.001|--exact|--scene scene'
input='--run 2|--strict|--digits 5|--plain'
declare -A begin=(
  [smooth]='smooth gap'
  [differentiate]='differentiate roll'
  [shift-from-accel]='shift-from-accel -K 0.5 -R 0.04 roll'
  [fitpower]='fitpower --route shift -K 0.6 -R 0.05 roll'
  [simulate]='simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 0.5'
  [energy-ledger]='energy-ledger -m 1 -K 0.5 -R 0.04 roll'
)
declare -A options=(
  [smooth]="-c D|-M savgol|-w 5|--seconds 0.3|--order 4|--outliers 2|--coast|--rolls|--from 3|--to 4|--equal-times mean|--use t=x|$input"
  [differentiate]="-c x|-M savgol|-w 5|--order 4|--use t=x|$input"
  [shift-from-accel]="--use a=v|$scene|$input"
  [fitpower]="--min-speed 0.2|--x0 0.1|--law d0+d1*v|--robust|--each|--fix a=1.7e-3|--report|--check|--accept CR.csv|--use D=x|$scene|$input"
  [simulate]="--x0 0.1|--t0 1|--law law|--law row|--law table|--law rows --run two|--memory 1e-3|--damping 0.01|--method rkf45|--rtol 1e-3|--report|--dt 0.1|--until 1.5|--at moments|--columns x,v|--sensor pasco|--seed 5|--rate 20|--resolution 0.01|--noise 0.002|--lost 0.2|$scene|--digits 16|--plain"
  [energy-ledger]="-a 1e-3|-b 0.1|--law row|--law table|--columns E_trans,F_N,A,Pi_S,W_g|--summary|--check 1e-3|--accept CR.csv|--use v=x|$scene|$input"
)

# result TOOL OPTION...: what this prints, without run times, and the exit status; `refused`
declare -A results=()
result() {
  local key="$*"
  if [ -z "${results[$key]-}" ]; then
    # shellcheck disable=SC2086
    attempt ${begin[$1]} "${@:2}"
    [ "$status" = 2 ] && results[$key]=refused ||
      results[$key]="$status $(cat out err | sed -E 's/ +[0-9.e+-]+ +[0-9.e+-]+$//' | cksum)"
  fi
  printed=${results[$key]}
}

for tool in $tools; do
  IFS='|' read -ra all <<<"${options[$tool]}"
  result "$tool"
  none=$printed
  for one in "${all[@]}"; do
    # shellcheck disable=SC2086
    result "$tool" $one
    alone=$printed
    [ "$alone" != "$none" ] || complain "$tool: $one is without effect"
    for other in "${all[@]}"; do
      [ "${one%% *}" != "${other%% *}" ] || continue
      [[ "|$excused|" != *"|$one $other|"* ]] || continue
      in_turn || continue
      # shellcheck disable=SC2086
      result "$tool" $one $other
      [ "$printed" = refused ] || [ "$printed" != "$alone" ] ||
        complain "$tool $one: $other is without effect"
    done
  done
  for option in $("$tool" --help | grep -oE '^ +(-.,)?--[a-z0-9-]+' | sed 's/.*--/--/'); do
    # A wind and a height need a law and a scene of their own: tests/tools has cases of both.
    case $option in
      --help | --version | --quiet | --unbuffered | --temperature | --wind | --height | --steepness) continue ;;
    esac
    short=$("$tool" --help | grep -oE "^ +-.,$option\b" | grep -oE '\-[A-Za-z]' | head -n 1)
    [[ "${begin[$tool]}|${options[$tool]}|" =~ [\ \|]($option${short:+|$short})[\ \|] ]] ||
      complain "$tool: $option is not tried"
  done
done
finish
