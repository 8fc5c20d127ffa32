#!/usr/bin/env bash
# check.sh [-m M] [-K K] [-R R] [-c x|v] RECORD FIT: fails unless a law a v^b describes the positions
# of RECORD, and unless the law in FIT, a row of fit.sh, dissipates what the measured velocities of
# RECORD lose, within 5 %. Prints both energies.
set -euo pipefail
export LC_ALL=C
unset CDPATH
m=1.375 K=0.5 R=0.04 column=x
while getopts m:K:R:c: option; do
  case $option in
    m) m=$OPTARG ;;
    K) K=$OPTARG ;;
    R) R=$OPTARG ;;
    c) column=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
PATH=$(cd "$(dirname "$0")/../.." && pwd)/bin:$PATH

read -r a b < <(awk -F'\t' '!/^#/ { print $2, $4 }' "$2")
roll() { smooth -q --coast -c $column -w 1 -- "$1"; }
velocity() { if [ $column = x ]; then roll "$1" | differentiate -q -c x; else roll "$1"; fi; }
# Velocities are not asked: the program of the sensor has computed each from several positions, so
# their noise is not white, and the check of the residuals would blame the law for it.
if [ $column = x ]; then
  roll "$1" | fitpower -q --check --route position -K "$K" -R "$R" >/dev/null
fi
# The first and last five means are over fewer records and noisier: they are left out.
velocity "$1" | smooth -q -c v -w 11 |
  awk '/^#/ { print; next } { row[++n] = $0 } END { for (i = 6; i <= n - 5; i++) print row[i] }' |
  energy-ledger -m "$m" -K "$K" -R "$R" -a "$a" -b "$b" --summary --check 0.05
