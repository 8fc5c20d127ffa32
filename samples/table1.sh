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
# Of closure and imbalance. Over 160 seeds the closure scatters by 1.2 % (the speeds at both ends, the
# error of the fit), and the largest imbalance, of a noisy speed anywhere, is 3.5 %.
tolerance=0.05

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

# The mat takes what the law of the trajectory says at the measured speeds; the body loses what its
# measured speeds say. The ends of the speeds are left away: the mean there has a shrunken window.
speeds() {
  velocity "$1" |
    awk '/^#/ { print; next } { line[++n] = $0 } END { for (i = 6; i <= n - 5; i++) print line[i] }'
}
# The row of the balance of a run under a law: E_start E_end E_diss closure imbalance.
balance() {  # NAME K OPTION...
  local name=$1 K=$2
  shift 2
  speeds "$name" | energy-ledger -m 1.375 -K "$K" -R 0.04 --summary "$@" | grep -v '^#'
}
echo
echo "Energy: measured loss against what the fitted shift dissipates (within $tolerance at every moment)"
printf '  %-4s %-20s %-12s %-16s %-10s %s\n' run "E at the start [J]" "lost [J]" "dissipated [J]" closure imbalance
for run in "CF F 0.5" "CR C 0.5" "SF F 0.83" "SR S 0.83"; do
  read -r name fit K <<<"$run"
  read -r a _ b _ < <(grep -v '^#' "$scratch/$fit.fit")
  { balance "$name" "$K" -a "$a" -b "$b" --check "$tolerance" || echo open; } |
    awk -v name="$name" '/open/ { open = 1 } /^[0-9]/ { start = $1; end = $2; diss = $3; closure = $4; imbalance = $5 }
      END { printf "  %-4s %-20.5f %-12.5f %-16.5f %-+10.4f %.4f%s\n", name, start, start - end, diss, closure, imbalance, open ? "  OPEN" : ""; exit open }' || failed=1
done

# The first expectation in joules, and the only check that feels K: it cancels where fit and ledger
# are of one body. A K_S that is 3 % too large lifts one closure by 1.4 % and lowers the other. The
# error is that of the fit: of sigma_a, sigma_b and corr.
echo
echo "The same with the law of the other body on that mat, and with the paper's law for that body"
printf '  %-4s %-8s %-12s %-16s %-20s %s\n' run "law of" "lost [J]" "dissipated [J]" closure "closure, paper's law"
for run in "CF SF 0.5 5.75e-4 2.44e-2" "SF CF 0.83 5.75e-4 2.44e-2" "CR S 0.5 1.78e-3 2.55e-1" "SR C 0.83 1.87e-3 2.15e-1"; do
  read -r name fit K paper_a paper_b <<<"$run"
  read -r a sigma_a b sigma_b corr _ < <(grep -v '^#' "$scratch/$fit.fit")
  {
    echo "$sigma_a $sigma_b $corr"
    balance "$name" "$K" -a "$a" -b "$b"
    balance "$name" "$K" -a "$(awk -v a="$a" -v s="$sigma_a" 'BEGIN { printf "%.17g", a + s }')" -b "$b"
    balance "$name" "$K" -a "$a" -b "$(awk -v b="$b" -v s="$sigma_b" 'BEGIN { printf "%.17g", b + s }')"
    balance "$name" "$K" -a "$paper_a" -b "$paper_b"
  } | awk -v name="$name" -v fit="$fit" -v tolerance="$tolerance" '
    NR == 1 { corr = $3; next }
    { closure[NR - 1] = $4 }
    NR == 2 { lost = $1 - $2; diss = $3 }
    END {
      by_a = closure[2] - closure[1]; by_b = closure[3] - closure[1]
      error = sqrt(by_a^2 + by_b^2 + 2 * corr * by_a * by_b)
      off = closure[1] - closure[4]; far = off^2 > (tolerance + 4 * error)^2
      printf "  %-4s %-8s %-12.5f %-16.5f %-+7.4f +- %-9.4f %+.4f%s\n", name, fit, lost, diss, closure[1], error, closure[4], far ? "  TOO FAR" : ""
      exit far
    }' || failed=1
done
echo
cat <<'TEXT'
On felt the law of one body closes the ledger of the other: one law, and both K are right within some
3 %, for the speeds at the ends make closures scatter by 1.2 %. On rubber the cylinder's law takes a
tenth too much from the shell, and the shell's law as much too little from the cylinder, as the paper's
own values do; to make one law of them, K of the shell would have to be off by 0.2. "Nearly the same
for both bodies" means, on rubber, within a tenth of the energy.
TEXT
exit $failed
