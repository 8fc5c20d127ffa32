#!/bin/bash
# The suite under valgrind, but for the tests of options, limits and the house: no byte used that nobody wrote, none lost. In a
# copy whose bin/ holds, for each tool, a script that runs it so; where standard output is closed valgrind's log would be it, so
# there the tool runs without. Some twenty minutes.
set -u
cd "$(dirname "$0")/.." || exit 2
command -v valgrind >/dev/null || { echo 'skipped: no valgrind'; exit 77; }
copy=$PWD/build/valgrind
rm -rf "$copy"
mkdir -p "$copy/bin" "$copy/build" "$copy/log"
cp -R Makefile README.md samples man tests "$copy"
under_valgrind() {  # PROGRAM SCRIPT
  printf '#!/bin/sh\n[ -e /proc/self/fd/1 ] || exec "%s" "$@"\nexec valgrind --quiet --leak-check=full --error-exitcode=99 --log-file="%s/log/%%p" "%s" "$@"\n' "$1" "$copy" "$1" >"$2"
  chmod +x "$2"
}
for tool in bin/*; do under_valgrind "$PWD/$tool" "$copy/$tool"; done
under_valgrind "$PWD/build/unit" "$copy/build/unit"
"$copy/tests/run.sh" "$copy/build/unit" "$copy"/tests/{tools,pipeline/*.sh,faults/{corpus,fields}.sh}
status=$?
findings=$(find "$copy/log" -type f -size +0)
[ -z "$findings" ] || xargs head -n 40 <<<"$findings"
echo "$(find "$copy/log" -type f | wc -l) runs under valgrind, $(grep -c . <<<"$findings") of them with findings"
[ "$status" -eq 0 ] && [ -z "$findings" ]
