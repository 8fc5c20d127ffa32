#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A car coasts down both ways over hills of 1 m (speeds at 1 Hz, 0.05 m/s of noise): f0 = d0 m g/R comes
# out to 0.35 N, with a constant slope fitted too, where a level road is told to 30 N; and to 0.41 N if
# the places where the runs begin are fitted too. A ball in a bowl (positions at 25 Hz, 0.3 mm of noise):
# D to 0.5 %, with a factor of the height fitted too.
set -u
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 2
export LC_ALL=C
noisy() {  # SEED SIGMA: of the second column
  awk -v seed="$1" -v sigma="$2" 'BEGIN { srand(seed) } /^##/ { next } /^#/ || !NF { print; next }
    { print $1 "\t" $2 + sigma * sqrt(-2 * log(1 - rand())) * cos(6.283185307179586 * rand()) }'
}
printf '# d0[m]\td2[s^2/m]\n3.058103975535168e-3\t8.154943934760448e-6\n' >car
printf 'd0\n2.54e-5\n' >ball
awk 'BEGIN { OFMT = CONVFMT = "%.17g"; pi = atan2(0, -1); print "# x[m]\th[m]"; for (x = -60; x < 2500; x += 10) print x "\t" sin(2 * pi * x / 800) }' >hills
awk 'BEGIN { OFMT = CONVFMT = "%.17g"; print "# x[m]\th[m]"; for (i = -30; i <= 30; i++) print i / 100 "\t" 1.14 * sin(i / 114) ^ 2 }' >bowl
simulate -K 0.04 -R 0.3 --law car --v0 33 --height hills --until 140 --dt 1 --columns t,v >both
echo >>both
simulate -K 0.04 -R 0.3 --law car --v0 -33 --x0 2400 --height hills --until 140 --dt 1 --columns t,v >>both
simulate -K 0.4 -R 0.0127 --law ball --v0 0 --x0 0.15 --height bowl --until 9 --dt 0.04 --columns t,x >swings
cars=8 least=6 balls=3
[ -z "${LONG-}" ] || cars=40 least=34 balls=6
roads() {  # LARGEST_SIGMA [OPTION]...
  for seed in $(seq $cars); do
    noisy "$seed" 0.05 <both | fitpower -q -K 0.04 -R 0.3 --law d0+d2*v^2 --height hills --slope fit "${@:2}" | tail -n 1
  done | awk -v n="$cars" -v least=$least -v most="$1" '{ f0 += $2 * 49050; covered += ($1 - 3.058103975535168e-3)^2 < (1.96 * $2)^2; level += ($8 / $9)^2 < 1.96^2 }
    END { printf "f0 +- %.3f N, covered in %d of %d; slope in %d\n", f0 / n, covered, n, level
      exit !(NR == n && f0 / n < most && covered >= least && level >= least) }'
}
roads 0.36 --x0 0,2400 || exit 1
roads 0.41 || exit 1
for seed in $(seq $balls); do
  noisy "$seed" 3e-4 <swings | fitpower -q -K 0.4 -R 0.0127 --law d0 --height bowl --steepness fit | tail -n 1
done | awk -v n="$balls" '{ D += $2 / 2.54e-5 / n; squares += (($1 - 2.54e-5) / $2)^2 }
  END { printf "D +- %.2f %%, squares %.2g of %d\n", 100 * D, squares, n; exit !(NR == n && D < 0.005 && squares < 17) }'
