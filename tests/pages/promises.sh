#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The table of tests/README.md, "What is promised": each page still says what stands there, every page
# has a row, and each test that is named exists: a script, the cases of a file, unit tests.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0 rows=0
complain() { echo "$*" && wrong=1; }
overstrike=$(printf '\b')
for page in man/*.?; do
  ! command -v mandoc >/dev/null ||
    mandoc -Tascii "$page" | sed "s/.$overstrike//g" | tr -s ' \n' ' ' >"$scratch/${page#man/}"
done
sed -n '/^## What is promised/,/^## /p' tests/README.md | grep '^| [a-z-]*([1-7]) ' >"$scratch/table"
awk -F '"' '/^TEST_CASE\(/ { due = 1 } due && NF > 1 { print $2; due = 0 }' tests/unit/*/*.cpp \
  tests/pipeline/*.cpp >"$scratch/units"

named() {  # TEST
  case $1 in
    *.sh) [ -x "$1" ] ;;
    *.cases:*)
      local file=${1%%:*} pattern=${1#*:} name
      while IFS= read -r name; do
        # shellcheck disable=SC2053  # a pattern
        [[ ${name// /-} != $pattern ]] || return 0
      done < <(sed -n 's/^=== //p' "$file")
      return 1 ;;
    build/unit\ *)
      local pattern=${1#build/unit } name
      pattern=${pattern#\'} pattern=${pattern%\'}
      while IFS= read -r name; do
        # shellcheck disable=SC2053
        [[ $name != $pattern ]] || return 0
      done <"$scratch/units"
      return 1 ;;
    make\ *) grep -qE "^${1#make }:" tests/targets.mk ;;
    *) return 1 ;;
  esac
}
while IFS='|' read -r _ page says tests _; do
  rows=$((rows + 1))
  page=$(sed -E 's/^ *(.*)\((.)\) *$/\1.\2/' <<<"$page")
  says=$(sed 's/^ *//; s/ *$//' <<<"$says")
  [ ! -e "$scratch/$page" ] || grep -qF -e "$says" "$scratch/$page" || complain "$page no longer says: $says (put its words of today into tests/README.md)"
  count=0
  while IFS= read -r test; do
    count=$((count + 1))
    named "$test" || complain "there is no test $test"
  done < <(grep -oE '`[^`]+`' <<<"$tests" | tr -d '`')
  [ $count -gt 0 ] || complain "no test for: $says"
done <"$scratch/table"
for page in man/*.?; do
  name=$(sed -E 's/.*\/(.*)\.(.)/\1(\2)/' <<<"$page")
  grep -qF "| $name |" "$scratch/table" || complain "no promise of $name has a row"
done
[ "$rows" -ge 40 ] || complain "only $rows promises"
exit $wrong
