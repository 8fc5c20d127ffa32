#!/bin/bash
# A test that must fail does fail: each of these cases is wrong in one way, and run.sh has to notice
# every one.
set -u
export LC_ALL=C
unset CDPATH
top=$(cd "$(dirname "$0")/../.." && pwd) || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0

# Runs run.sh on $scratch/t; it has to exit $1 and to end with the line $2.
expect() {
  local said status
  said=$("$top/tests/run.sh" "${@:3}" 2>&1)
  status=$?
  [ "$status" -eq "$1" ] && [ "$(tail -n 1 <<<"$said")" = "$2" ] && return
  printf 'instead of exit %s and "%s", exit %s and:\n%s\n' "$1" "$2" "$status" "$said" && wrong=1
}
# A case of this cmd and these FILE=TEXT.
make_case() {
  local pair
  rm -rf "$scratch/t"
  mkdir -p "$scratch/t/case"
  printf '%s\n' "$1" >"$scratch/t/case/cmd"
  for pair in "${@:2}"; do printf '%b' "${pair#*=}" >"$scratch/t/case/${pair%%=*}"; done
}
fails() { make_case "$@" && expect 1 '0 passed, 1 failed' "$scratch/t"; }
passes() { make_case "$@" && expect 0 '1 passed, 0 failed' "$scratch/t"; }

passes 'echo 1' expected='1\n'
fails 'echo 2' expected='1\n'
fails 'printf 1' expected='1\n'
fails 'echo 1'
fails 'echo 1; exit 2' expected='1\n'
fails 'echo 1' expected='1\n' status='2\n'
fails 'echo 1; exit 2' status='2\n'
passes 'exit 2' status='2\n'
fails 'echo 1; echo trouble >&2' expected='1\n'
fails 'echo 1' expected='1\n' stderr='trouble\n'
passes 'echo 1; echo trouble >&2' expected='1\n' stderr='trouble\n'
passes 'echo 1.0000001 a' expected='1 a\n' approx='1e-6'
fails 'echo 1.00001 a' expected='1 a\n' approx='1e-6'
fails 'echo 1 b' expected='1 a\n' approx='1e-6'
fails 'echo 1 a a' expected='1 a\n' approx='1e-6'
fails 'echo 1; echo 1' expected='1\n' approx='1e-6'
fails 'echo 1' expected='1\n1\n' approx='1e-6'
fails 'echo "# a"; echo 1' expected='# b\n1\n' approx='1e-6'
fails 'echo nan' expected='1\n' approx='1e-6'
fails 'echo inf' expected='1\n' approx='1e-6'
fails 'echo 1e-9' expected='0\n' approx='1e-6'
passes 'echo 1e-9' expected='0\n' approx='1e-6 1e-8'
fails ':' expected='' approx='1e-6'
fails 'echo "# a"' expected='# a\n' approx='1e-6'
fails 'echo 1' expected='1\n' approx='much'

# Scripts, units, and nothing at all.
script() { printf '#!/bin/sh\n%s\n' "$1" >"$scratch/s.sh" && chmod +x "$scratch/s.sh"; }
script 'exit 0' && expect 0 '1 passed, 0 failed' "$scratch/s.sh"
script 'exit 3' && expect 1 '0 passed, 1 failed' "$scratch/s.sh"
script 'echo why; exit 77' && expect 1 '0 passed, 0 failed, 1 skipped' "$scratch/s.sh"
rm -rf "$scratch/t" && mkdir "$scratch/t" && script 'exit 0' && cp "$scratch/s.sh" "$scratch/unit"
expect 1 '0 passed, 0 failed' "$scratch/t"
unit() { script "$1" && mv "$scratch/s.sh" "$scratch/unit"; }
unit 'echo "All tests passed (9 assertions in 3 test cases)"' && expect 0 '3 passed, 0 failed' "$scratch/unit" "$scratch/t"
unit 'echo "All tests passed (1 assertion in 1 test case)"' && expect 0 '1 passed, 0 failed' "$scratch/unit" "$scratch/t"
unit 'echo "test cases:  4 |  2 passed | 1 failed | 1 skipped"; exit 1' && expect 1 '2 passed, 1 failed, 1 skipped' "$scratch/unit" "$scratch/t"
unit 'echo "All tests passed (9 assertions in 3 test cases)"; exit 139' && expect 1 '3 passed, 1 failed' "$scratch/unit" "$scratch/t"
unit 'kill -SEGV $$' && expect 1 '0 passed, 1 failed' "$scratch/unit" "$scratch/t"
unit 'echo "No tests ran"' && expect 1 '0 passed, 1 failed' "$scratch/unit" "$scratch/t"
exit $wrong
