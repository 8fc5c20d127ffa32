#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tools.sh [TIMES]: what each tool costs on the smallest scene, ten rows: user and system time of a
# start (of TIMES, 100, less those of /bin/true; at most 3 ms), its size (stripped, at most 1.5 MiB), and
# the libraries that it takes besides those of C++.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
times=${1:-100}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
scene='-K 0.5 -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5'
PATH=$PWD/bin:$PATH
simulate $scene --dt 0.2 --until 1.9 --columns t,v,a,D >"$scratch/rows"
milliseconds() {  # COMMAND...
  local TIMEFORMAT='%U %S' i
  { time for ((i = 0; i < times; i++)); do "$@" >/dev/null 2>&1; done; } 2>&1 | awk -v n="$times" '{ print 1000 * ($1 + $2) / n }'
}
nothing=$(milliseconds /bin/true)
printf '# tool\tstart[ms]\tsize[MiB]\tlibraries\n'
for tool in smooth differentiate 'shift-from-accel -K 0.5 -R 0.04' 'fitpower --route shift' "simulate $scene --dt 1" \
  'energy-ledger -m 1 -K 0.5 -R 0.04'; do
  file=$scratch/rows
  case $tool in simulate*) file= ;; esac
  # shellcheck disable=SC2086  # words
  $tool $file >/dev/null 2>&1
  # shellcheck disable=SC2086
  taken=$(milliseconds $tool $file)
  strip -o "$scratch/stripped" "bin/${tool%% *}"
  printf '%s\t%.1f\t%.2f\t%s\n' "${tool%% *}" "$(awk "BEGIN { print $taken - $nothing }")" \
    "$(awk "BEGIN { print $(wc -c <"$scratch/stripped") / 1048576 }")" \
    "$(ldd "bin/${tool%% *}" | awk '$1 !~ /vdso|ld-linux|libc[.]|libm[.]|libstdc|libgcc/ { sub(/[.]so.*/, "", $1); print $1 }' | sort | xargs)"
done
