#!/bin/bash
# The corpus of each tool under valgrind: no byte read that was not written, none lost. The tools are those of bin/.
set -u
cd "$(dirname "$0")/.." || exit 2
command -v valgrind >/dev/null || { echo 'skipped: no valgrind'; exit 77; }
wrong=0 count=0
for file in tests/fuzz/corpus/{smooth,differentiate,shift-from-accel,fitpower,simulate,energy-ledger}/*; do
  tool=$(basename "$(dirname "$file")")
  read -r -a arguments <"$file"
  tail -n +2 "$file" | valgrind --quiet --leak-check=full --error-exitcode=99 "bin/$tool" "${arguments[@]}" >/dev/null 2>"${TMPDIR:-/tmp}/valgrind.$$"
  [ "${PIPESTATUS[1]}" -ne 99 ] || { wrong=1 && echo "$file:" && head -n 20 "${TMPDIR:-/tmp}/valgrind.$$"; }
  count=$((count + 1))
done
rm -f "${TMPDIR:-/tmp}/valgrind.$$"
echo "$count runs under valgrind"
exit $wrong
