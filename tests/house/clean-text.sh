#!/bin/bash
# Nothing is half there: a case has its cmd and an expectation, a file of lib/ that computes has its
# unit test, a test is run.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
wrong=0
complain() { echo "$*" && wrong=1; }

for folder in tests/tools/*/*/; do
  [ -s "${folder}cmd" ] || complain "$folder has no cmd"
  [ -e "${folder}expected" ] || [ -e "${folder}status" ] ||
    complain "$folder has neither expected nor status"
  tool=$(basename "$(dirname "$folder")")
  grep -q -e "$tool" "${folder}cmd" || complain "${folder}cmd does not run $tool"
done
for source in cmd/*.cpp; do
  tool=$(basename "$source" .cpp)
  [ -d "tests/tools/$tool" ] || complain "tests/tools/$tool: no cases"
done

# A unit test includes the header of each source of lib/, or that of a source which is made of it.
# Without: what only a command as a whole can show.
included() { sed -nE 's|^#include "([^"]*)\.h".*|\1|p' "$@" | sort -u; }
tested=$(included tests/unit/*/*)
for name in $tested; do
  [ ! -e "lib/$name.h" ] || tested+=$'\n'$(included "lib/$name".*)
done
for source in lib/*/*.cpp; do
  name=${source#lib/}
  name=${name%.cpp}
  case $name in
    cli/command_line | cli/progress) continue ;;
  esac
  [ -e "tests/unit/${name}_test.cpp" ] || grep -qxF "$name" <<<"$tested" ||
    complain "$source: no unit test of it"
done
if grep -rnE '^(<<<<<<<|>>>>>>>)( |$)' Makefile README.md cmd lib tests samples man; then complain "a merge that was not finished"; fi
for script in tests/*.sh tests/*/*.sh; do
  [ -x "$script" ] || complain "$script cannot be run"
done
exit $wrong
