#!/bin/bash
# Nothing is half there: a case has its cmd and an expectation, a file of lib/ that computes has its
# unit test, a test is run.
set -u
cd "$(dirname "$0")/../.." || exit 2
wrong=0
complain() { echo "$*" && wrong=1; }

for folder in tests/tools/*/*/; do
  [ -s "${folder}cmd" ] || complain "$folder has no cmd"
  [ -e "${folder}expected" ] || [ -e "${folder}status" ] || complain "$folder has neither expected nor status"
  tool=$(basename "$(dirname "$folder")")
  grep -q -e "$tool" "${folder}cmd" || complain "${folder}cmd does not run $tool"
done
for source in cmd/*.cpp; do
  tool=$(basename "$source" .cpp)
  [ -d "tests/tools/$tool" ] || complain "tests/tools/$tool: no cases"
done

# Without a unit test of their own: GSL's handler and messages, and what only a command as a whole
# can show.
for source in lib/*/*.cpp; do
  name=${source#lib/}
  case $name in
    base/gsl.cpp | cli/tool.cpp | cli/progress.cpp) continue ;;
  esac
  [ -e "tests/unit/${name%.cpp}_test.cpp" ] || complain "$source has no tests/unit/${name%.cpp}_test.cpp"
done
if grep -rnE '^(<<<<<<<|>>>>>>>)( |$)' Makefile README.md cmd lib tests samples man; then complain "a merge that was not finished"; fi
for script in tests/*.sh tests/*/*.sh; do
  [ -x "$script" ] || complain "$script cannot be run"
done
exit $wrong
