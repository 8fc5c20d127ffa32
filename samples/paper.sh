#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# paper.sh [-K K -R R -m M FILE]: prints a table of the equations (numbers in parentheses), tables, figures
# and claims of the paper, each with the command that computes or draws it and what comes out: for the
# samples, or for your own run with positions, which is run.csv here. The commands run in this order beside
# the folder samples. Numbers in columns are rounded to 6 digits. Exits with 1 if a command fails.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
options '-K -R -m' "$@"
set -- ${operands[@]+"${operands[@]}"}
[ $# -le 1 ] || wrong "one run, not $#"
[ $# = 1 ] || [ -z "$chosen" ] || wrong "${chosen##* } is for a run of your own: name its FILE"
for number in ${1+"${K%%+-*}" "${K#*+-}" "${R%%+-*}" "${R#*+-}" "$m"}; do
  is_number "${number:-x}" || wrong 'say what rolled: -K 0.5 -R 0.04 -m 1.375'
done
samples=$(cd "$(dirname "$0")" && pwd)
make_scratch
[ $# = 0 ] || cp -- "$1" "$scratch/run.csv"
cd "$scratch"
ln -s "$samples" samples

# row WHAT COMMAND: out comes the last row of columns, every line of a text, the title of a picture, or,
# if nothing is printed, what is said.
failed=0
row() {
  eval "$2" >out 2>said || { cat said >>out && failed=1; }
  case $2 in *.svg) sed -n '/<title>/ { s:.*<title>\(.*\)</title>.*:\1:p; q; }' "${2##*>}" >out ;; esac
  [ -s out ] || cp said out
  what=$1 command=$2 awk -F '\t' '
    /^##/ || /^$/ { next }
    NF < 2 { line[++lines] = $0; next }
    !n { sub(/^# /, ""); n = split($0, name); next }
    { split($0, value) }
    END {
      for (i = 1; i <= n; i++) {
        unit = name[i]
        sub(/^[^[]*\[?/, "", unit); sub(/\]/, "", unit); sub(/\[.*/, "", name[i])
        line[lines = 1] = line[1] (i > 1 ? ", " : "") name[i] sprintf(" %.6g ", value[i]) unit
      }
      gsub(/ ,/, ",", line[1]); sub(/ $/, "", line[1])
      printf "%-52s  %-68s%s\n", ENVIRON["what"], ENVIRON["command"], (lines == 1 ? "  " line[1] : "")
      for (i = 1; i <= lines && lines > 1; i++) print "      " line[i]
    }' out
}

printf '%-52s  %-68s  %s\n' 'of the paper' command 'what comes out'
runs='samples/SR samples/CF samples/SF samples/CR' expected='/^What the/,/^$/p; /^The same/,/^$/p' body=''
if [ $# = 1 ]; then
  runs=run expected='/^D of each/,/^$/p' body=" -K $K -R $R -m $m run.csv"
  row 'the body' "printf 'mass = $m\\nradius = \"$R\"\\nshape-factor = \"$K\"\\n' >run.toml"
fi
for run in $runs; do
  roll="simulate -q --scene $run.toml" until='' t=0 name=${run##*/}
  row "$name: its free roll" "smooth --coast -c x $run.csv >roll"
  [ -s roll ] || wrong "$(cat said)"
  row "$name: its law, D = a v^b; v0 < 0: towards the sensor" "fitpower -q --scene $run.toml roll >law && cut -f 1,3,8 law"
  [ -s law ] || wrong "$(cat said)"
  row "$name: its velocities" "differentiate -q -c x -M savgol -w $(window 0.84 roll 3) roll >speeds"
  row "$name, measured: closures of p (4), L (5), E (23)" "energy-ledger -q --scene $run.toml --law law --summary speeds"
  [ $# = 0 ] || roll='simulate -q --law law' t=$(columns law t0)
  $roll --exact >motion 2>said || until=" --until $(columns roll t | tail -n 1)"  # it does not stop
  row "$name: its motion with A of (8)" "$roll --exact$until >motion"
  row "$name, simulated: closures of p (4), L (5), E (23)" "energy-ledger -q --scene $run.toml --summary motion"
done
row "$name at the first instant" "printf 't\\n$t\\n' | $roll --exact --at - >instant"
row '(9) solved for D' "cut -f 1,3,4 instant | shift-from-accel -q --scene $run.toml --exact"
row "(11) D = (1 + K) R s, with s = -v'/g" "cut -f 1,3,4 instant | shift-from-accel -q --scene $run.toml"
half=$(columns motion t | awk -v t="$t" 'END { printf "%.6g", t + ($1 - t) / 2 }')
row "(12) v' = -c D, and (13) v(t), after half of the time" "printf 't\\n$half\\n' | $roll --at - --columns t,v,a,D"
row "$name: columns at the instant" \
  "ledger() { energy-ledger --scene $run.toml --temperature 293 --columns \$1 \${2-instant} | cut -f 3,6-; }"
while read -r list what; do row "$what" "ledger $list"; done <<'LIST'
omega (1) v = omega R
J (2) J = K m R^2
p,L (3) L = K R p_x
F_H,I_pH (4) m v' = F_H
tau_N,tau_H (5) L' = tau_N + tau_H
A,F_H,tau_H (6) tau_H = -A R F_H
D,F_N,tau_N (7) tau_N = -D F_N, with F_N = m g
D,A (8) A = sqrt(1 - D^2/R^2)
D,A,F_N,F_H (9) F_H = -D F_N / ((K + A) R)
A,tau_N,tau_H (10) tau_N / tau_H = -(K/A + 1)
vP_H,I_pH,P_T1 (14) P_T1 = (v - v(P)_H) I_pH
vP_H,I_pH,I_E1,vP_V,I_pN,I_E2 (15) I_E1 = v(P)_H I_pH and I_E2 = v(P)_V I_pN
A,vP_H (16) v(P)_H = (1 - A) v
A,F_H,I_E1 (17) I_E1 = -(1 - A) v F_H
A,D,P_T1,P_R1 (18) P_T1 = A v D m g / (R (K + A)), P_R1 = -P_T1
D,P_R2,P_T2 (19) P_R2 = (v/R) D m g, P_T2 = -P_R2
D,vP_V (20) v(P)_V = -(D/R) v
D,F_N,I_E2 (21) I_E2 = (D/R) v F_N
I_E1,I_E2,P_diss (22) I_E1 + I_E2 = -(K + 1) m v v'
F_S,F_H,F_N,D Fig. 2: F_S passes ahead of the axis: |F_H|/F_N < D/R
P_T3,P_T4,P_diss Fig. 5: all is dissipated, P_T3 + P_T4 = P_diss
F_G,F_S,I_pH,I_pN,I_LH,I_LN,E Table 2: forces, currents, energy
P_diss,Pi_S,I_S Table 2: entropy, Pi_S = P_diss/T = I_S
LIST
row 'Table 2: transferred in the whole motion' 'ledger p_tr,L_trH,L_trN,E_tr motion'
row 'Table 1' "samples/table1.sh${1+ run.csv} | tee table1 | sed -n '/^  route/,/^$/p'"
row 'what is expected of D(v)' "sed -n '$expected' table1"
row 'Fig. 1: just before rest the body rolls backwards' \
  "samples/roll-back.sh -K $(value shape-factor $run.toml) -R $(value radius $run.toml) $run.csv"
row 'note 23: K measured, on made runs' 'samples/shape-factor.sh | grep K'
for figure in fig1 fig1-stop fig2 fig3 fig4 fig5; do row "Fig. ${figure#fig}" "samples/figures/$figure.sh$body >$figure.svg"; done
exit $failed
