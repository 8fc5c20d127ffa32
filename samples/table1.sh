#!/bin/bash
# Table 1 and the check of the dissipated energy, from the raw records alone: samples/table1.sh (bash, the tools on PATH).
# Exits with 1 when a recovered value is more than 4 standard errors from the paper's, or an energy balance is open.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
tolerance=0.05  # of a closure: over many seeds it scatters about 0 by 1.5 % (the speeds at both ends, the error of the fit)

roll() { smooth -q --coast -c x -w 1 "$1.csv"; }               # the free roll in a raw record, its positions as they are
velocity() { roll "$1" | differentiate -q -c x | smooth -w 11; }  # v from the positions, smoothed
shift_of() { velocity "$1" | differentiate | shift-from-accel -K "$2" -R 0.04; }  # Fig. 4: D of v

# The two routes to a and b: through D(v), and by the simulated trajectory.  fits NAME K FILE [K FILE]
fits() {
  local name=$1 shapes=() records=() shifts=()
  shift
  while [ $# -gt 0 ]; do
    shift_of "$2" "$1" >"$scratch/$2.D"
    roll "$2" >"$scratch/$2.roll"
    shapes+=("$1") shifts+=("$scratch/$2.D") records+=("$scratch/$2.roll")
    shift 2
  done
  fitpower -q "${shifts[@]}" >"$scratch/$name.D.fit"
  fitpower -q --route position -K "$(IFS=,; echo "${shapes[*]}")" -R 0.04 "${records[@]}" >"$scratch/$name.fit"
}

# The row of a fit beside the paper's a and b.
compare() {
  awk -v route="$2" -v a="$3" -v b="$4" '!/^#/ {
    off_a = ($1 - a) / $2; off_b = ($3 - b) / $4; far = off_a^2 > 16 || off_b^2 > 16
    printf "  %-24s %7.4f +- %.4f  %7.4f +- %.4f  %+5.1f  %+5.1f%s\n", route, 1e3 * $1, 1e3 * $2, $3, $4, off_a, off_b, far ? "  TOO FAR" : ""
    exit far }' "$scratch/$1" || failed=1
}

table() {  # NAME TITLE A B K FILE [K FILE]
  local name=$1 title=$2 a=$3 b=$4
  shift 4
  fits "$name" "$@"
  awk -v title="$title" -v a="$a" -v b="$b" 'BEGIN { printf "%s\n  %-24s %7.4f            %7.4f\n", title, "paper", 1e3 * a, b }'
  compare "$name.D.fit" "D(v), Fig. 4" "$a" "$b"
  compare "$name.fit" "trajectory x(t)" "$a" "$b"
}

echo "Table 1, D = a v^b: from the raw records in samples/, beside the paper's values; distances in standard errors"
echo
printf '  %-24s %-17s  %-17s  %-5s  %s\n' route "a [1e-3 m]" b "off a" "off b"
table S "rubber mat, shell" 1.78e-3 2.55e-1 0.83 SR
table C "rubber mat, cylinder" 1.87e-3 2.15e-1 0.5 CR
table F "felt mat, both in one fit" 5.75e-4 2.44e-2 0.5 CF 0.83 SF

# Each body on felt by itself, for the first expectation.
fits CF 0.5 CF
fits SF 0.83 SF

echo
echo "What the paper expects of D(v)"
awk '
  FNR == 1 { file = FILENAME; sub(/.*\//, "", file); sub(/\.fit$/, "", file) }
  !/^#/ { a[file] = $1; b[file] = $3 }
  function D(which, v) { return a[which] * v^b[which] }
  function say(what, figure, rule, holds) { printf "  %-53s %-24s %-14s %s\n", what, figure, rule, holds ? "yes" : "NO"; failed += !holds }
  END {
    rubber = D("S", 0.25) / D("C", 0.25); felt = D("SF", 0.25) / D("CF", 0.25)
    say("nearly the same for both bodies: D_S/D_C at 0.25 m/s", sprintf("rubber %.3f felt %.3f", rubber, felt), "within 15 %", (rubber - 1)^2 < 0.0225 && (felt - 1)^2 < 0.0225)
    C = D("C", 0.5) / D("C", 0.1); S = D("S", 0.5) / D("S", 0.1); F = D("F", 0.5) / D("F", 0.1)
    say("strongly nonlinear on rubber: D(0.5)/D(0.1)", sprintf("C %.3f S %.3f", C, S), "above 1.25", C > 1.25 && S > 1.25)
    say("hardly on felt: D(0.5)/D(0.1)", sprintf("%.3f", F), "below 1.10", F < 1.1)
    say("smaller on felt: D_felt/D_rubber at 0.25 m/s", sprintf("C %.3f S %.3f", D("F", 0.25) / D("C", 0.25), D("F", 0.25) / D("S", 0.25)), "below 1", D("F", 0.25) < D("C", 0.25) && D("F", 0.25) < D("S", 0.25))
    printf "  %-53s %.1e on rubber, %.1e on felt\n", "1 - A, which the fits set to 0, at 0.5 m/s", 1 - sqrt(1 - (D("C", 0.5) / 0.04)^2), 1 - sqrt(1 - (D("F", 0.5) / 0.04)^2)
    exit failed > 0
  }' "$scratch"/{S,C,F,CF,SF}.fit || failed=1

# The mat takes what the law of the trajectory says at the measured speeds; the body loses what its measured speeds say.
# Their ends are left away: the mean there has a shrunken window.
echo
echo "Energy: measured loss against what the fitted shift dissipates (closure within $tolerance)"
printf '  %-4s %-22s %-20s %-16s %s\n' run "E at the start [J]" "lost [J]" "dissipated [J]" closure
for run in "CF F 0.5" "CR C 0.5" "SF F 0.83" "SR S 0.83"; do
  read -r name fit K <<<"$run"
  read -r a _ b _ < <(grep -v '^#' "$scratch/$fit.fit")
  velocity "$name" | awk '/^#/ { print; next } { line[++n] = $0 } END { for (i = 6; i <= n - 5; i++) print line[i] }' |
    { energy-ledger -m 1.375 -K "$K" -R 0.04 -a "$a" -b "$b" --summary --check "$tolerance" || echo open; } |
    awk -v name="$name" '/open/ { open = 1 } /^[0-9]/ { start = $1; end = $2; diss = $3; closure = $4 }
      END { printf "  %-4s %-22.5f %-20.5f %-16.5f %+.4f%s\n", name, start, start - end, diss, closure, open ? "  OPEN" : ""; exit open }' || failed=1
done
exit $failed
