#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How fast the tools are, beside the peers that are installed and beside bare loops: one table with
# ratios, spread and goal.
#
#   tests/bench/speed.sh [--long] [ROWS [ROUNDS]]
#
# Rows of the large file (5000000) and rounds of each pair, in turn (7). A * marks pairs that other
# processes disturbed in spite of repetitions. --long measures memory and growth up to 10^8 rows,
# and what building takes. Needs build/bench/speed, and the tools on the PATH; leaves its files in
# build/speed/.
set -euo pipefail
export LC_ALL=C
unset CDPATH
long=false
[ "${1:-}" != --long ] || { long=true && shift; }
rows=${1:-5000000} rounds=${2:-7}
speed=$PWD/build/bench/speed approx=$PWD/tests/approx.awk
mkdir -p build/speed
cd build/speed
body='-K 0.5 -R 0.04' ledger='-m 1.375 -K 0.5 -R 0.04'

# --- files: t v of a cart that rolls to and fro, with the sensor's digits and some noise
make_tv() {  # ROWS
  mawk -v n="$1" 'BEGIN {
    srand(1)
    print "# t[s]\tv[m/s]"
    for (i = 0; i < n; i++) printf "%.3f\t%.6f\n", i / 1000, 0.5 * sin(i / 30000) + 0.002 * rand()
  }'
}
make_tv "$rows" >tv.txt
tail -n +2 tv.txt >tv.plain                     # for the bare loop and peers without names
small=$((rows < 1000000 ? rows : 1000000))
head -n $((small + 1)) tv.txt >small.txt
tail -n +2 small.txt >small.plain
head -n 20001 tv.txt >head.txt
sed 's/\t/,/; s/^# //' small.txt >comma.csv
sed 's/[^\t]*/"&"/g; s/\t/,/; s/"# /"/' small.txt >quoted.csv
tail -n +2 quoted.csv >quoted.plain
mawk -v n="$small" 'BEGIN {
  srand(4)
  print "# t[s]\tv[m/s]"
  for (i = 0; i < n; i++) printf "%.17g\t%.17g\n", (i + rand() / 3) / 1000, 0.5 * sin(i / 30000) + 0.002 * rand()
}' >digits17.txt
sed 's/\t/;/; /^#/!s/\./,/g; s/^# //' small.txt >decimal-comma.csv
differentiate small.txt >tva.txt
mawk 'BEGIN { OFS = "\t"; print "# t[s]\tv[m/s]\tD[m]" }
  !/^#/ { print $1, $2, 0.0018 * (1 + $2 / 4) }' small.txt >tvD.txt
make_vD() {  # CORRELATION of the noise from one row to the next
  mawk -v n="$small" -v r="$1" 'BEGIN {
    srand(5)
    print "# v[m/s]\tD[m]"
    for (i = 1; i <= n; i++) {
      v = 0.02 + 0.5 * rand()
      e = r * e + rand()
      printf "%.6f\t%.9f\n", v, 0.00187 * v ^ 0.215 * (1 + 0.02 * e)
    }
  }'
}
# Of white runs one in twenty looks correlated at 10 %, which takes longer. The first one does
# not (p = 0.27 for 10^6 rows); the other does.
make_vD 0 >vD.txt
make_vD 0.5 >vD-correlated.txt
simulate -K 0.5 -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5 --until 2 --columns t,v \
  --dt "$(mawk -v n="$small" 'BEGIN { print 2.2 / n }')" |
  mawk 'BEGIN { srand(3); OFS = "\t"; print "# t[s]\tv[m/s]" }
    !/^#/ { printf "%s\t%.6f\n", $1, $2 + 0.002 * (rand() + rand() - 1) }' >roll.txt

# --- the peers' programs, at full precision, for evenly spaced times
mean='!/^#/ {
  s += $2 - (n >= 11 ? V[n % 11] : 0); V[n % 11] = $2; T[n % 11] = $1; n++
  if (n >= 11) printf "%s\t%.17g\n", T[(n + 5) % 11], s / 11
  else if (n % 2) printf "%s\t%.17g\n", T[(n - 1) / 2], s / n
}
END { for (w = 9; w > 0; w -= 2) {
    s -= V[(n - w - 1) % 11] + V[(n - w - 2) % 11]
    printf "%s\t%.17g\n", T[(n - (w + 1) / 2) % 11], s / w } }'
slope='!/^#/ {
  if (++n > 2) {
    if (n == 3) printf "%s\t%.17g\n", L[1], (4 * v2 - 3 * v1 - $2) / ($1 - t1)
    printf "%s\t%.17g\n", l2, ($2 - v1) / ($1 - t1)
  } else L[n] = $0
  t0 = t1; v0 = v1; t1 = t2; v1 = v2; l2 = $0; t2 = $1; v2 = $2
}
END { printf "%s\t%.17g\n", l2, (3 * v2 - 4 * v1 + v0) / (t2 - t0) }'
shift_='!/^#/ { printf "%s\t%.17g\n", $0, -1.5 * 0.04 * $3 / 9.81 }'
energies='!/^#/ {
  v = $2; D = $3; F = -D * m * g / (1.5 * R); P = D / R * v * m * g
  if (n++) E += (P + P0) / 2 * ($1 - t0)
  P0 = P; t0 = $1
  printf "%s\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\t%.17g\n", $0, m * v * v / 2, 0.5 * m * v * v / 2, 0, P, -F * v, F * v, P, -P, P, E
}'
energies="BEGIN { m = 1.375; R = 0.04; g = 9.81 } $energies"
loglog='!/^#/ { x = log($1); y = log($2); n++; sx += x; sy += y; sxx += x * x; sxy += x * y }
END { b = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  printf "%.17g\t%.17g\n", exp((sy - b * sx) / n), b }'

python=$(for p in python3 /usr/bin/python3; do ! "$p" -c 'import pandas, scipy' 2>/dev/null ||
  { echo "$p" && break; }; done)
have() { command -v "$1" >/dev/null; }
same() {  # WHAT TOLERANCE EXPECTED ACTUAL: the peer computes the same
  mawk -v tolerance="$2" -f "$approx" <(grep -v '^#' "$3") <(grep -v '^#' "$4") ||
    { echo "speed.sh: $1: the peer computes something else" >&2; exit 1; }
}
last=''
row() {  # WHAT PEER RATE RATIO LEAST GREATEST GOAL DISTURBED: a goal is at least N, or at most N with <
  local met=''
  case $7 in
    '') ;;
    '<'*) met=$(mawk -v r="$4" -v g="${7#<}" 'BEGIN { print (r <= g ? "yes" : "NO") }') ;;
    *) met=$(mawk -v r="$4" -v g="$7" 'BEGIN { print (r >= g ? "yes" : "NO") }') ;;
  esac
  [ "$1" != "$last" ] || set -- '' "${@:2}"
  last=${1:-$last}
  [ "${8:-0}" = 0 ] || met="$met *"
  printf '%-38s %-22s %9s %8.4g  %8.4g - %-8.4g %8s  %s\n' "$1" "$2" "$3" "$4" "$5" "$6" "$7" "$met"
}
# Ratio of the peer's time to ours; `inverse`: of ours to the other's.
against() {  # WHAT PEER ROWS GOAL OURS THEIRS [user|cpu|elapsed [inverse]]
  local a r least greatest disturbed
  read -r a _ r least greatest disturbed < <("$speed" compare "$rounds" "${7:-user}" "$5" "$6")
  local rate
  rate=$(mawk -v n="$3" -v t="$a" 'BEGIN { printf "%.2f", n / t / 1e6 }')
  [ "${8:-}" != inverse ] ||
    read -r r least greatest < <(
      mawk -v r="$r" -v l="$least" -v g="$greatest" 'BEGIN { print 1 / r, 1 / g, 1 / l }')
  row "$1" "$2" "$rate" "$r" "$least" "$greatest" "$4" "$disturbed"
}

printf '# %s rows of t v, %d rounds; %s\n' "$rows" "$rounds" "$(uname -m), $(nproc) processors, $(date +%Y-%m-%d)"
printf '%-38s %-22s %9s %8s  %-19s %8s  %s\n' '# what' beside Mrow/s ratio '   least - greatest' goal met

# --- peers: how many times faster
if have mawk; then
  mawk "$mean" head.txt >peer.out && smooth head.txt >ours.out &&
    same smooth '1e-9 1e-12' peer.out ours.out
  mawk "$slope" head.txt >peer.out && differentiate head.txt >ours.out &&
    same differentiate '1e-6 1e-6' peer.out ours.out
  head -n 20001 tva.txt >head3.txt
  mawk "$shift_" head3.txt >peer.out && shift-from-accel $body head3.txt >ours.out &&
    same shift-from-accel '1e-14 1e-300' peer.out ours.out
  head -n 20001 tvD.txt >head3.txt
  # E_diss, the last column, is of parabolas there and of straight lines here.
  mawk "$energies" head3.txt | cut -f 1-12 >peer.out &&
    energy-ledger $ledger head3.txt | grep -v '^#' | cut -f 1-12 >ours.out &&
    same energy-ledger '1e-9 1e-14' peer.out ours.out
  against smooth 'mawk %.17g' "$rows" 8 'smooth tv.txt' "mawk '$mean' tv.txt"
fi
if [ -n "$python" ]; then
  against smooth pandas "$small" '' 'smooth small.txt' "$python -c '
import pandas
f = pandas.read_csv(\"small.txt\", sep=\"\t\", skiprows=1, names=[\"t\", \"v\"])
f.v = f.v.rolling(11, center=True).mean()
f.to_csv(\"/dev/stdout\", sep=\"\t\", index=False)'"
fi
if have mlr; then against smooth Miller "$small" '' 'smooth small.txt' "mlr --inidx --otsv --ifs tab step -a slwin_5_5 -f 2 small.plain"; fi
against smooth 'bare loop (at most)' "$rows" '<1.25' 'smooth tv.txt' "$speed filter <tv.txt" user inverse
against smooth '  quoted' "$small" '<1.25' 'smooth quoted.csv' "$speed filter <quoted.plain" user inverse
against smooth '  17 digits' "$small" '<1.25' 'smooth digits17.txt' "$speed filter <digits17.txt" user inverse
if have mawk; then against differentiate 'mawk %.17g' "$rows" 8 'differentiate tv.txt' "mawk '$slope' tv.txt"; fi
against differentiate 'bare loop (at most)' "$rows" '<1.25' 'differentiate tv.txt' "$speed filter <tv.txt" user inverse
against differentiate '  quoted' "$small" '<1.25' 'differentiate quoted.csv' "$speed filter <quoted.plain" user inverse
against differentiate '  17 digits' "$small" '<1.25' 'differentiate digits17.txt' "$speed filter <digits17.txt" user inverse
if have mawk; then against shift-from-accel 'mawk %.17g' "$small" 4 "shift-from-accel $body tva.txt" "mawk '$shift_' tva.txt"; fi
against shift-from-accel 'bare loop (at most)' "$small" '<1.25' "shift-from-accel $body tva.txt" "$speed filter <tva.txt" user inverse
differentiate digits17.txt >tva17.txt
against shift-from-accel '  17 digits' "$small" '<1.25' "shift-from-accel $body tva17.txt" "$speed filter <tva17.txt" user inverse
if have mawk; then
  against 'the three in a pipe' 'mawk %.17g' "$rows" 7 "smooth tv.txt | differentiate | shift-from-accel $body" "mawk '$mean' tv.txt | mawk '$slope' | mawk '$shift_'" elapsed
fi
against 'the three in a pipe' 'three loops (at most)' "$rows" '<1.1' "smooth tv.txt | differentiate | shift-from-accel $body" "$speed filter <tv.txt | $speed filter | $speed filter" cpu inverse
if have mawk; then against 'energy-ledger, 10 columns' 'mawk %.17g' "$small" 6 "energy-ledger $ledger tvD.txt" "mawk '$energies' tvD.txt"; fi
against 'energy-ledger, 10 columns' 'bare loop (at most)' "$small" '<1.25' "energy-ledger $ledger tvD.txt" "$speed filter 10 <tvD.txt" user inverse
if have datamash; then
  against 'energy-ledger --summary' 'datamash mean 1-3' "$small" '' "energy-ledger --summary $ledger tvD.txt" "tail -n +2 tvD.txt | datamash mean 1 mean 2 mean 3"
fi
if have mawk; then against 'fitpower --route loglog' mawk "$small" '' 'fitpower -q --route loglog vD.txt' "mawk '$loglog' vD.txt"; fi
"$speed" fit <vD.txt >peer.out && fitpower -q --route loglog vD.txt | cut -f 1-4 >ours.out && same 'fitpower --route loglog' '1e-8 1e-300' peer.out ours.out
against 'fitpower --route loglog' 'bare loop (at most)' "$small" '<1.5' 'fitpower -q --route loglog vD.txt' "$speed fit <vD.txt" user inverse
against 'fitpower --route loglog' '  correlated noise' "$small" '' 'fitpower -q --route loglog vD-correlated.txt' "$speed fit <vD-correlated.txt" user inverse
if [ -n "$python" ]; then
  cat >curve_fit.py <<'END'
import numpy, scipy.optimize, sys
t, v = numpy.loadtxt("roll.txt", unpack=True)
def speed(t, a, b, v0):  # v^(1 - b) = v0^(1 - b) - (1 - b) g a t / ((1 + K) R)
    return numpy.maximum(v0 ** (1 - b) - (1 - b) * 9.81 * a * t / (1.5 * 0.04), 0) ** (1 / (1 - b))
p, C = scipy.optimize.curve_fit(speed, t, v, p0=[1e-3, 0.1, 0.5])
print(*p[:2])
END
  against 'fitpower --route velocity' 'scipy curve_fit' "$small" 5 "fitpower --route velocity $body roll.txt" "$python curve_fit.py"
fi
if have gnuplot; then
  against 'fitpower --route loglog' gnuplot "$small" '' 'fitpower -q --route loglog vD.txt' "gnuplot -e 'set fit quiet logfile \"/dev/null\"; la = -6; b = 0.1; fit la + b * x \"vD.txt\" using (log(\$1)):(log(\$2)) via la, b' 2>/dev/null"
fi
scene='-K 0.5 -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5'
dt=$(mawk -v n="$rows" 'BEGIN { printf "%.17g", 2 / n }')
against 'simulate --columns t,v' 'bare loop (at most)' "$rows" '<1.2' "simulate $scene --dt $dt --until 2 --columns t,v" "$speed print $rows" user inverse

# --- what should not matter: ratios near 1
against 'smooth -w 10001' '-w 11 (at most)' "$rows" '<1.3' 'smooth -w 10001 tv.txt' 'smooth tv.txt' user inverse
for form in comma quoted decimal-comma; do
  against "differentiate $form.csv" 'tabs (at most)' "$small" '<2' "differentiate $form.csv" 'differentiate small.txt' user inverse
done

# --- growth, memory: the file of 10^7 rows has 0.7 GB, and goes again
echo
echo '# rows      ns a row, peak MiB: smooth       differentiate    shift-from-accel energy-ledger    (at most 8 MiB; user and system time)'
for n in 1000 100000 1000000 10000000 $($long && echo 100000000 || true); do
  printf '%9d                    ' "$n"
  dt=$(mawk -v n="$n" 'BEGIN { printf "%.17g", 2.1 / n }')
  simulate $scene --dt "$dt" --until 2 --columns t,v,a,D >grow.txt
  for tool in smooth differentiate "shift-from-accel $body" "energy-ledger $ledger"; do
    read -r t _ < <("$speed" compare 1 cpu "$tool grow.txt" true)
    peak=$("$speed" peak "$tool grow.txt")
    mawk -v t="$t" -v n="$n" -v p="$peak" 'BEGIN {
        printf "%7.0f %5.1f    ", 1e9 * t * 2.1 / 2 / n, p / 1024 }'
  done
  echo
done
rm -f grow.txt

echo
../../tests/bench/tools.sh

if $long; then
  echo
  echo '# building the six tools from nothing, user and system time [s] (at most 60)'
  rm -rf fresh && mkdir fresh && cp -r ../../Makefile ../../lib ../../cmd fresh/
  TIMEFORMAT='%U + %S'
  { time CCACHE_DISABLE=1 make -s -C fresh all CXX=g++; } 2>&1
  rm -rf fresh
fi

if have parallel; then
  echo
  echo '# chains of three at once, GNU parallel: rows a second in all [Mrow/s]'
  cat >chain.sh <<END
smooth small.txt | differentiate | shift-from-accel $body >/dev/null
END
  for jobs in 1 2 4; do
    read -r t _ < <("$speed" compare "$rounds" elapsed "seq $jobs | parallel -j $jobs -n0 sh chain.sh" true)
    mawk -v j="$jobs" -v n="$small" -v t="$t" 'BEGIN { printf "%d %8.2f\n", j, j * n / t / 1e6 }'
  done
fi
