#!/bin/sh
# The balance of a simulated roll closes, and a law 5 % too large is caught and measured.
scene=samples/CR.toml
simulate --scene $scene | energy-ledger --scene $scene --check 1e-3 --summary || { echo "the true law does not close"; exit 1; }
row=$(simulate --scene $scene | energy-ledger --scene $scene -a 1.9635e-3 --check 1e-3 --summary 2>"${TMPDIR:-/tmp}/energy-check.$$")
status=$?
said=$(cat "${TMPDIR:-/tmp}/energy-check.$$")
rm -f "${TMPDIR:-/tmp}/energy-check.$$"
[ $status -eq 1 ] || { echo "exit $status instead of 1"; exit 1; }
case $said in
  "energy-ledger: the check does not hold: closure 0.0"*) ;;
  *) echo "said: $said"; exit 1 ;;
esac
# The same speeds with a 5 % larger shift dissipate 5 % more.
echo "$row" | awk '!/^#/ { exit !($4 > 0.0499 && $4 < 0.0501) }' || { echo "closure: $row"; exit 1; }
