#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
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
# A file of one case, of this command and these blocks.
make_case() {
  rm -rf "$scratch/t" && mkdir "$scratch/t"
  printf '=== a case\n%s\n' "$1" >"$scratch/t/a.cases"
  [ $# = 1 ] || printf '%b\n' "${@:2}" >>"$scratch/t/a.cases"
}
fails() { make_case "$@" && expect 1 '0 passed, 1 failed' "$scratch/t"; }
passes() { make_case "$@" && expect 0 '1 passed, 0 failed' "$scratch/t"; }
# A file of cases that cannot be read, for this reason.
refused() { make_case "${@:2}" && expect 2 "$scratch/t/a.cases:$1" "$scratch/t"; }

passes 'echo 1' '--- stdout\n1'
fails 'echo 2' '--- stdout\n1'
fails 'printf 1' '--- stdout\n1'
fails 'echo 1' '--- stdout\n1\n1'
fails 'echo 1; echo' '--- stdout\n1'
passes 'echo 1; echo' '--- stdout\n1\n'
fails 'echo 1; exit 2' '--- stdout\n1'
fails 'echo 1' '--- stdout\n1' '--- status 2'
fails 'echo 1; exit 2' '--- status 2'
passes 'exit 2' '--- status 2'
fails 'echo 1; echo trouble >&2' '--- stdout\n1'
fails 'echo 1' '--- stdout\n1' '--- stderr\ntrouble'
passes 'echo 1; echo trouble >&2' '--- stdout\n1' '--- stderr\ntrouble'
passes 'cat "a b" && ls ../samples/CR.toml' '--- a b\n\n1\n' '--- stdout\n\n1\n\n../samples/CR.toml'
fails 'cat input' '--- input\n1\n' '--- stdout\n1'
passes 'echo 1.0000001 a' '--- stdout within 1e-6\n1 a'
fails 'echo 1.00001 a' '--- stdout within 1e-6\n1 a'
fails 'echo 1 b' '--- stdout within 1e-6\n1 a'
fails 'echo 1 a a' '--- stdout within 1e-6\n1 a'
fails 'echo 1; echo 1' '--- stdout within 1e-6\n1'
fails 'echo 1' '--- stdout within 1e-6\n1\n1'
fails 'echo "# a"; echo 1' '--- stdout within 1e-6\n# b\n1'
fails 'echo nan' '--- stdout within 1e-6\n1'
fails 'echo inf' '--- stdout within 1e-6\n1'
fails 'echo 1e-9' '--- stdout within 1e-6\n0'
passes 'echo 1e-9' '--- stdout within 1e-6 1e-8\n0'
fails ':' '--- stdout within 1e-6'
fails 'echo "# a"' '--- stdout within 1e-6\n# a'
fails 'echo 1' '--- stdout within 1e\n1'
refused '2: the case above has no stdout' 'echo 1'
refused '3: the case above has no command' '# echo 1' '--- stdout'
refused '3: not understood: --- stdout within much' 'echo 1' '--- stdout within much\n1'
refused '3: not understood: --- status 0' 'echo 1' '--- status 0'
refused '5: a second time in this case: --- stdout' 'echo 1' '--- stdout\n1' '--- stdout'
refused '5: no empty line above a case' 'echo 1' '--- stdout\n1' '=== next'
refused '6: a second case of this name' 'echo 1' '--- stdout\n1\n' '=== a case'
refused '4: nothing may stand here: 1' 'echo 1' '--- status 2\n1'

# Some of the cases of a file, by name, and what is not there.
make_case 'echo 1' '--- stdout\n1\n' '=== another one' 'echo 2' '--- stdout\n3'
expect 1 '1 passed, 1 failed' "$scratch/t/a.cases"
expect 0 '1 passed, 0 failed' "$scratch/t/a.cases:a-case"
expect 1 '0 passed, 1 failed' "$scratch/t/a.cases:*one"
expect 2 "run.sh: $scratch/t/a.cases: no case a" "$scratch/t/a.cases:a"

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
