#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# roll-back.sh -K K -R R [-w SECONDS] FILE: measures the brief roll backwards before a body rests, in a
# run with positions. It prints when it begins, how long it lasts, how far it goes, its highest speed,
# and the length of the memory of the bulge that explains it, with standard uncertainties; or it says
# that the roll is not above the noise.
#
# Velocities are slopes of parabolas over SECONDS (0.08), or over five rows if that is more. The
# uncertainties are the scatter over 100 copies of the run with added noise of the size of the residuals.
# Up to 200 simulated runs without such a roll, with that noise, show how far noise alone goes: the roll
# counts as seen if at most 2 of them go as far.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
w=0.08
options '-K -R -w' "$@"
width=$w
set -- ${operands[@]+"${operands[@]}"}
[ "$K" ] && [ "$R" ] || wrong 'say what rolled: -K 0.5 -R 0.04'
is_number "$width" || wrong "-w $width: a number of seconds"
[ $# = 1 ] || wrong "one file, not $#"
make_scratch
smooth -w 1 -c x -- "$1" >"$scratch/read"
cd "$scratch"
awk '/^$/ { exit 1 }' read || wrong 'several runs: smooth --run N picks one'
smooth --coast -c x read >roll
fitpower --route position -K "$K" -R "$R" roll >fit
smooth -q --from "$(columns fit t0)" -c x read >rest
columns rest t x >readings
body=(simulate -q --law fit -K "$K" -R "$R")
stop=$("${body[@]}" --columns t | tail -n 1)
"${body[@]}" --at rest --columns x | grep -v '^#' >law
rms=$(columns fit rms)
turn=1
case $(columns fit v0) in -*) turn=-1 ;; esac  # towards falling x

# The readings near the stop; then copies of them with noise; then the law with noise.
paste readings law | awk -F '\t' -v stop="$stop" -v rms="$rms" -v turn=$turn "$random"'
  $1 > stop - 0.5 && $1 < stop + 1.5 { t[++n] = $1; x[n] = turn * $2; rest[n] = turn * $3 }
  END {
    if (n < 12 || t[n] < stop + 0.3) exit 2
    print "# t[s]\tx[m]"
    for (copy = 0; copy <= 300; copy++) {
      if (copy) print ""
      for (i = 1; i <= n; i++)
        printf "%.17g\t%.17g\n", t[i], (copy <= 100 ? x[i] : rest[i]) + (copy ? rms * normal() : 0)
    }
  }' >copies || wrong "the run ends at the stop, at $(printf %.2f "$stop") s: it has no rest"
rows=$(window "$width" rest 5)
# backward FILE: of each run in it the stretch around the lowest velocity, from zero to zero: begin,
# duration, way, speed.
backward() {
  differentiate -c x -M savgol -w "$rows" "$1" | smooth -c x -M savgol -w "$rows" | awk -F '\t' -v stop="$stop" '
    function share(a, b) { return a == b ? 0 : a / (a - b) }  # of the way to where it is 0
    function found(  low, i, j, here, there) {
      for (i = 1; i <= n; i++) if (t[i] > stop - 0.3 && t[i] < stop + 1 && (!low || v[i] < v[low])) low = i
      if (!(v[low] < 0)) { print stop, 0, 0, 0; return }
      for (i = low; i > 2 && v[i - 1] < 0;) i--
      for (j = low; j < n - 1 && v[j + 1] < 0;) j++
      here = share(v[i], v[i - 1])
      there = share(v[j], v[j + 1])
      begin = t[i] + here * (t[i - 1] - t[i])
      print begin, t[j] + there * (t[j + 1] - t[j]) - begin, \
        x[i] + here * (x[i - 1] - x[i]) - x[j] - there * (x[j + 1] - x[j]), -v[low]
    }
    /^#/ { next }
    NF { t[++n] = $1; x[n] = $2; v[n] = $3; next }
    { found(); n = 0 }
    END { found() }'
}
backward copies >found
# The length of a memory with which the fitted roll comes back as far; a law with b < 0 has none.
L=$(awk 'NR == 1 { print $3 / 2 }' found)
for _ in 1 2 3 4 5; do
  awk "BEGIN { exit !($L > 0) }" && "${body[@]}" --memory "$L" --at rest --columns t,x >remembers 2>/dev/null ||
    { L='' && break; }
  awk -F '\t' -v OFS='\t' -v turn=$turn '/^#/ { print; next } { print $1, turn * $2 }' remembers >memory
  L=$(backward memory | awk -v L="$L" -v way="$(awk 'NR == 1 { print $3 }' found)" '{ print ($3 > 0 ? L * way / $3 : L / 2) }')
done
awk -v L="$L" '
  NR == 1 { for (i = 1; i <= 4; i++) value[i] = $i; next }
  NR <= 101 { for (i = 1; i <= 4; i++) squares[i] += ($i - value[i])^2; next }
  { alone++; if ($3 >= value[3]) as_far++ }
  END {
    for (i = 1; i <= 4; i++) sigma[i] = sqrt(squares[i] / 100)
    if (as_far > 2) {
      printf "not seen above the noise: of %d such runs of a body that rests at once %d show as much\n", alone, as_far
      exit
    }
    printf "begins at %.3f +- %.3f s, lasts %.3f +- %.3f s, goes %.2f +- %.2f mm, at most %.1f +- %.1f mm/s",
      value[1], sigma[1], value[2], sigma[2], 1e3 * value[3], 1e3 * sigma[3], 1e3 * value[4], 1e3 * sigma[4]
    if (L != "") printf ";\nas with a memory of %.3f +- %.3f mm, without damping", 1e3 * L, 1e3 * L * sigma[3] / value[3]
    print ""
  }' found
