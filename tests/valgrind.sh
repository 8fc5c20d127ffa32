#!/bin/bash
# The suite under valgrind, but for the tests of limits and of the house: no byte used that nobody wrote, none lost. In a copy
# whose bin/ holds, for each tool, a script that runs it so.
set -u
cd "$(dirname "$0")/.." || exit 2
command -v valgrind >/dev/null || { echo 'skipped: no valgrind'; exit 77; }
copy=$PWD/build/valgrind
rm -rf "$copy"
mkdir -p "$copy/bin" "$copy/build" "$copy/log"
cp -R Makefile README.md samples man tests "$copy"
under_valgrind() {  # PROGRAM SCRIPT
  printf '#!/bin/sh\nexec valgrind --quiet --leak-check=full --error-exitcode=99 --log-file="%s/log/%%p" "%s" "$@"\n' "$copy" "$1" >"$2"
  chmod +x "$2"
}
for tool in bin/*; do under_valgrind "$PWD/$tool" "$copy/$tool"; done
under_valgrind "$PWD/build/unit" "$copy/build/unit"
"$copy/tests/run.sh" "$copy/build/unit" "$copy"/tests/{tools,pipeline/*.sh,faults/{corpus,fields,options}.sh}
status=$?
find "$copy/log" -size +0 -exec cat {} +
echo "$(find "$copy/log" -type f | wc -l) runs under valgrind, $(find "$copy/log" -size +0 | wc -l) of them with findings"
[ "$status" -eq 0 ] && [ -z "$(find "$copy/log" -size +0)" ]
