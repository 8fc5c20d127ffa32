#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the tests and counts them. It prints a line as each group of tests ends, then what was
# skipped and how to have it; the last line is `N passed, N failed`, with `, N skipped` if any were.
#
#   tests/run.sh [UNIT-PROGRAM] [FOLDER | FILE.cases[:NAME] | SCRIPT.sh]...
#
# UNIT-PROGRAM is a Catch2 program (2.13 or 3): each of its test cases counts. A FOLDER is searched
# for files of cases, a SCRIPT is one test. Without these: all cases of tests/tools, all scripts of
# tests/{pipeline,faults,pages,install,house}. With :NAME only the cases of that name, a pattern of
# the shell in which hyphens stand for blanks: tests/tools/smooth/filters.cases:mean-*
#
# A file of cases holds for each of them what is true, the lines of a shell, and what they print:
#
#   === mean by hand
#   smooth -w 3 input
#   --- input
#   0 1
#   1 5
#   2 3
#   --- stdout
#   # t[s]	v[m/s]
#   0	1
#   1	3
#   2	3
#   <an empty line, which belongs to no block>
#   === the next case
#
#   --- stdout                   standard output, byte for byte; needed where the status is 0, and
#   --- stdout within 1e-9 1e-12 with tolerances, relative and absolute, compared by approx.awk
#   --- stderr                   standard error, byte for byte; without it there must be none
#   --- status N                 exit status; 0 without it
#   --- NAME                     any other name is a file in the folder where the lines run
#
# The lines run with bin/ on the PATH, nothing on standard input, in a new folder of the case; its
# neighbours are ../samples and the files that stand above the first case. The version in a line
# `## fitpower VERSION ...` is not compared. What a file of text does not
# show (CR, a last line without its end) is made by printf. Above the first case also comments.
# A script runs at the top of the checkout: status 0 is passed, 77 is skipped (its last line says
# why, and how to have it), anything else is failed.
set -u
export LC_ALL=C
unset CDPATH
root=$(cd "$(dirname "$0")/.." && pwd) || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM
# A case has 60 seconds of a processor, since a busy machine is not its fault, and ten minutes of the
# clock, in case it waits for something. A machine SLOWER times slower, as an emulator, has so much
# more time for each test, and leaves out the unit tests that fit [many] rows.
slower=${SLOWER:-1}
export PATH="$root/bin:$PATH" TMPDIR="$scratch"

# Each of these takes the path of a test and a folder of its own, says what is wrong, and leaves its
# counts (passed, failed, skipped) in that folder.

run_unit() {
  local status summary passed failed skipped
  "$1" ${SLOWER:+'~[many]~[.]'} >"$2/out" 2>&1
  status=$?
  # All tests passed (9 assertions in 3 test cases)
  # test cases: 4 | 2 passed | 1 failed | 1 skipped
  summary=$(grep -E '^(All tests passed \(|test cases: )' "$2/out" | tail -n 1)
  count() { grep -oE "[0-9]+ $1" <<<"$summary" | head -n 1 | grep -oE '[0-9]+' || echo 0; }
  case $summary in
    All*) passed=$(count 'test case') failed=0 ;;
    *) passed=$(count passed) failed=$(count 'failed($| *\|)') ;;
  esac
  skipped=$(count skipped)
  if [ "$status" -ne 0 ] || [ "$failed" -ne 0 ] || [ "$passed" -eq 0 ]; then
    [ "$failed" -ne 0 ] || failed=1
    cat "$2/out"
    echo "FAIL $1: exit $status"
  fi
  echo "$passed $failed $skipped" >"$2/counts"
}

run_case() {  # the path of a case, as plan_cases left it
  local status wanted=0 expected=/dev/null errors=/dev/null
  [ ! -f "$1.status" ] || wanted=$(<"$1.status")
  [ ! -f "$1.stdout" ] || expected=$1.stdout
  [ ! -f "$1.stderr" ] || errors=$1.stderr
  (cd "$1" && ulimit -t "$((60 * slower))" && TMPDIR=$2 exec timeout "$((600 * slower))" \
    bash "$1.command") </dev/null >"$2/out" 2>"$2/err"
  status=$?
  if [ "$status" = "$wanted" ] && [ ! -f "$1.within" ] && same "$expected" "$2/out" && same "$errors" "$2/err"; then
    echo 1 0 0 >"$2/counts"
    return
  fi
  # The version of a build is not what a case is about.
  sed -i 's/^## fitpower 1[^ ]* /## fitpower VERSION /' "$2/out"
  {
    [ "$status" = "$wanted" ] || echo "exit $status instead of $wanted"
    if [ -f "$1.within" ]; then
      awk -v tolerance="$(<"$1.within")" -f "$root/tests/approx.awk" "$expected" "$2/out"
    else
      diff -u --label expected "$expected" --label 'standard output' "$2/out"
    fi
    diff -u --label expected "$errors" --label 'standard error' "$2/err"
  } >"$2/wrong" 2>&1
  if [ -s "$2/wrong" ]; then
    echo "FAIL $(<"$1.title")"
    grep -v '^#' "$1.command"
    cat "$2/wrong"
    echo 0 1 0 >"$2/counts"
  else
    echo 1 0 0 >"$2/counts"
  fi
}

# Whether two files of text are the same, which starts no program: what is not is compared by diff.
same() {
  local one other
  ! IFS= read -rd '' one <"$1" && ! IFS= read -rd '' other <"$2" && [ "$one" = "$other" ]  # no NUL
}

run_script() {
  (cd "$root" && TMPDIR=$2 exec timeout "$((1200 * slower))" "$1") </dev/null >"$2/out" 2>&1
  local status=$?
  case $status in
    0) echo 1 0 0 >"$2/counts" ;;
    77)
      echo "SKIP ${1#"$root"/}: $(tail -n 1 "$2/out" | sed 's/^skipped: //')"
      echo 0 0 1 >"$2/counts"
      ;;
    *)
      echo "FAIL ${1#"$root"/}: exit $status"
      cat "$2/out"
      echo 0 1 0 >"$2/counts"
      ;;
  esac
}

absolute() { echo "$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"; }

# A group is what one line of progress tells of: the unit tests, the cases of a tool, a folder of
# scripts.
kinds=() paths=() groups=()
plan() {  # KIND PATH GROUP
  kinds+=("$1") paths+=("$2") groups+=("$3")
}
plan_cases() {  # FILE.cases [NAME]
  local folder number line name found=false of=${1#"$root"/}
  folder=$(mktemp -d) && ln -s "$root/samples" "$folder" &&
    number=$(grep -c '^=== ' "$1") && (cd "$folder" && eval "mkdir {1..$number}") &&
    awk -v into="$folder" -f "$root/tests/cases.awk" "$1" >"$folder.list" || exit 2
  while read -r number line name; do
    # shellcheck disable=SC2053  # a pattern
    [[ ${name// /-} == ${2-*} ]] || continue
    echo "$of:$line: $name" >"$folder/$number.title"
    plan case "$folder/$number" "${of%.cases}"
    found=true
  done <"$folder.list"
  $found || { echo "run.sh: $of: no case ${2-}" && exit 2; }
}
plan_script() {
  local group=${1%/*}
  plan script "$1" "${group#"$root"/}"
}
plan_folder() {
  local file
  while IFS= read -r file; do
    plan_cases "$file"
  done < <(find "$1" -name '*.cases' -type f | sort)
}
more=false
for argument; do
  file=${argument%%.cases:*}
  if [ -d "$argument" ]; then
    plan_folder "$(absolute "$argument")"
    more=true
  elif [ "$file" != "$argument" ] && [ -f "$file.cases" ]; then
    plan_cases "$(absolute "$file.cases")" "${argument#"$file.cases:"}"
    more=true
  elif [ -f "$argument" ] && [[ $argument == *.cases ]]; then
    plan_cases "$(absolute "$argument")"
    more=true
  elif [ ! -x "$argument" ]; then
    echo "run.sh: $argument: no folder, no cases, and no program that can run"
    exit 2
  elif [[ $argument == *.sh ]]; then
    plan_script "$(absolute "$argument")"
    more=true
  else
    plan unit "$(absolute "$argument")" tests/unit
  fi
done
if ! $more; then
  for script in "$root"/tests/{pipeline,faults,pages,install,house}/*.sh; do
    [ ! -e "$script" ] || plan_script "$script"
  done
  plan_folder "$root/tests/tools"
fi

total_passed=0 total_failed=0 total_skipped=0
begins=()  # the first test of each group that has not been told
for i in "${!paths[@]}"; do
  [ "$i" -gt 0 ] && [ "${groups[i]}" = "${groups[i - 1]}" ] || begins+=("$i")
done

# Tells of each group whose tests have all ended, of the tests before $1; with `all`, of every group.
tell() {
  local first i passed failed skipped still=() sum bad
  for first in "${begins[@]}"; do
    for ((i = first; i < ${#paths[@]}; ++i)); do
      [ "${groups[i]}" = "${groups[first]}" ] || break
      [ "$1" = all ] || { [ "$i" -lt "$1" ] && [ -s "$scratch/$i/counts" ]; } || { still+=("$first") && continue 2; }
    done
    sum=0 bad=0
    for ((i = first; i < ${#paths[@]}; ++i)); do
      [ "${groups[i]}" = "${groups[first]}" ] || break
      if [ -s "$scratch/$i/says" ]; then
        grep -v '^SKIP ' "$scratch/$i/says"
        grep '^SKIP ' "$scratch/$i/says" >>"$scratch/skips"
      fi
      passed=0 failed=1 skipped=0
      if [ -s "$scratch/$i/counts" ]; then
        read -r passed failed skipped <"$scratch/$i/counts"
      else
        echo "FAIL ${paths[i]}: no result"
      fi
      total_passed=$((total_passed + passed)) total_failed=$((total_failed + failed))
      total_skipped=$((total_skipped + skipped))
      sum=$((sum + passed + failed)) bad=$((bad + failed))
    done
    [ $bad = 0 ] && bad='' || bad=", $bad of them failed"
    echo "${groups[first]}: $sum tests$bad, after $SECONDS s"
  done
  begins=("${still[@]}")
}

# As many at a time as there are processors.
slots=$(nproc 2>/dev/null || echo 2)
: >"$scratch/skips"
running=0
for i in "${!paths[@]}"; do
  mkdir "$scratch/$i"
  if [ "$running" -ge "$slots" ]; then
    wait -n
    running=$((running - 1))
    tell "$i"
  fi
  "run_${kinds[i]}" "${paths[i]}" "$scratch/$i" >"$scratch/$i/says" 2>&1 &
  running=$((running + 1))
done
while [ "$running" -gt 0 ]; do
  wait -n
  running=$((running - 1))
  tell ${#paths[@]}
done
tell all
cat "$scratch/skips"
[ "$((total_passed + total_failed))" -gt 0 ] || echo "nothing was tested"
summary="$total_passed passed, $total_failed failed"
[ "$total_skipped" -eq 0 ] || summary="$summary, $total_skipped skipped"
echo "$summary"
[ "$total_failed" -eq 0 ] && [ "$total_passed" -gt 0 ]
