#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# paper.sh: what it prints is what is kept; each equation that a row names holds for the numbers in it, and
# stands in rolling-motion(7) with the same number; nothing of the paper is left out, and faults are told.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# A body on a mat so soft that A is far from 1, which rolls towards falling x.
body='-K 0.7 -R 0.03 -m 0.9'
simulate -K 0.7 -R 0.03 -a 6e-3 -b 0.1 --v0 -3 --dt 0.01 --until 5 --columns t,x >"$scratch/run"
# shellcheck disable=SC2086  # words
samples/paper.sh $body "$scratch/run" >"$scratch/table" 2>"$scratch/said" || complain "paper.sh: $? $(cat "$scratch/said")"
for name in '('{1..23}')' 'Table '{1,2} 'Fig. '{1,1-stop,2,3,4,5} 'note 23'; do
  grep -qF -- "$name" "$scratch/table" || complain "no $name"
done

# The rows of equations, in awk: a blank between two factors is a product. The first row at the instant
# has the acceleration; what a row prints comes before what others print.
man=$(sed 's/\\(ha/^/g; s/\\(aq/'"'"'/g; s/  */ /g' man/rolling-motion.7)
awk -F '  +' '
  function code(text) {
    gsub(/v\(P\)_/, "vP_", text); gsub(/p_x/, "p", text)
    gsub(/L\047/, "(K R m acc)", text); gsub(/v\047/, "acc", text)
    while (match(text, /[A-Za-z0-9_)] [A-Za-z0-9_(]/)) text = substr(text, 1, RSTART) "*" substr(text, RSTART + 2)
    return text
  }
  function values(text,   n, i, at, part) {
    n = split(text, part, ", ")
    for (i = 1; i <= n; i++) {
      split(part[i], at, " ")
      print (at[1] == "a" ? "acc" : at[1]) " = " at[2]
    }
  }
  BEGIN { print "function near(x, y) { return (x - y)^2 <= (1e-4 * y)^2 }\nBEGIN { K = 0.7; R = 0.03; m = 0.9; g = 9.81; c = g / ((K + 1) * R)" }
  / its law/ { sub(/a /, "coefficient ", $3); sub(/v0/, "start", $3); values($3) }
  /^\(9\) solved/ { values($3); print "s = -acc/g; exact = acc; t0 = t" }
  /^\([0-9]+\) .* = / {
    print "acc = exact"
    values($3)
    split($1, number, " "); sub(/^[^ ]* /, "", $1)
    n = split($1, sides, /, with |, and |, | and /)
    for (i = 1; i <= n; i++) if (split(sides[i], side, " = ") == 2)
      printf "if (!near(%s, %s)) { print \"%s %s:\", %s, %s; bad = 1 } n++\n", code(side[1]), code(side[2]), number[1], sides[i], code(side[1]), code(side[2])
    if (/\(13\)/) print "if (!near((-v)^(1 - b), (-start)^(1 - b) - (1 - b) * coefficient * c * (t - t0))) { print \"(13)\", v; bad = 1 }"
  }
  /^Fig. 2: / { print "if (!(sqrt(F_H^2)/F_N < sqrt(D^2)/R)) { print \"Fig. 2\"; bad = 1 }" }
  /^Fig. 5: / { values($3); print "if (!near(P_T3 + P_T4, P_diss)) { print \"Fig. 5\"; bad = 1 }" }
  /^Table 2: entropy/ { values($3); print "if (!near(Pi_S, P_diss / 293)) { print \"entropy\"; bad = 1 }" }
  /^Table 2: trans/ { print "first = v"; values($3)
    print "if (!near(p_tr, m*(v - first)) || !near(L_trH + L_trN, K*R*p_tr) || !near(E_tr, (K + 1)*m*(v^2 - first^2)/2)) { print \"transferred\"; bad = 1 }" }
  END { print "if (n < 26) print n \" equations\"; exit bad || n < 26 }" }' "$scratch/table" >"$scratch/program"
awk -f "$scratch/program" || wrong=1
grep -oE '^\([0-9]+\) .* = .*' "$scratch/table" | sed 's/  .*//; s/, and (13).*//' | grep -vE '^\(1[45]\)' | while IFS= read -r row; do
  number=${row%% *} text=${row#* }
  grep -F -- "${text%%, with *}" <<<"$man" | grep -qF -- "$number" || { echo "rolling-motion(7) has no $row"; exit 1; }
done || wrong=1
# Closures: of the measured run to the error of the speeds at its ends, of the simulated motion to its own.
awk -F ', *|  +' '/: closures of/ {
    limit = /simulated/ ? 1e-4 : 0.03
    for (i = 1; i <= NF; i++) if ($i ~ /^closure/) { split($i, at, " "); if (at[2]^2 < limit^2) good++ }
  }
  END { exit good != 6 }' "$scratch/table" || complain 'closures'

# What is kept, from the samples and, with LONG=1, from the run of the other body.
samples/paper.sh >"$scratch/kept" || complain "paper.sh: $?"
sed '/^$/,$d' samples/paper.txt | diff - "$scratch/kept" || complain 'samples/paper.txt: make paper'
if [ "${LONG-}" ]; then
  another=$(sed -n 's/^Another body.*: //p' samples/paper.txt)
  $another >"$scratch/another"
  # shellcheck disable=SC2086  # words
  samples/paper.sh $body "$scratch/another" >"$scratch/kept"
  sed '1,/^Another/d' samples/paper.txt | diff - "$scratch/kept" || complain 'samples/paper.txt: make paper'
fi

refused() {  # MESSAGE OPERAND...
  local message=$1
  shift
  samples/paper.sh "$@" >"$scratch/out" 2>"$scratch/said"
  [ $? = 2 ] && [ "$(tail -n 1 "$scratch/said")" = "paper.sh: $message" ] || complain "$*: $(cat "$scratch/said")"
}
refused '-m is for a run of your own: name its FILE' -m 1
refused 'say what rolled: -K 0.5 -R 0.04 -m 1.375' -K 0.5 -R 0.04 "$scratch/run"
refused 'say what rolled: -K 0.5 -R 0.04 -m 1.375' -K '0.5; x' -R 0.04 -m 1 "$scratch/run"
refused 'one run, not 2' "$scratch/run" "$scratch/run"
printf 't,v\n0,1\n' >"$scratch/speeds"
# shellcheck disable=SC2086  # words
refused "smooth: run.csv: there is no column 'x' among t, v; say --use x=COLUMN" $body "$scratch/speeds"
exit $wrong
