#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The suite under valgrind, but for the tests of options, limits and rules: no byte used that nobody wrote, none lost. In a
# copy whose bin/ holds, for each tool, a script that runs it so. Only what valgrind finds counts: under it a long double, which
# some tests compare with, is no longer than a double, and limits of time or memory may be exceeded. Some twenty minutes.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/.." || exit 2
command -v valgrind >/dev/null ||
  { echo 'skipped: no valgrind; make setup sanitize installs it'; exit 77; }
copy=$PWD/build/valgrind
rm -rf "$copy"
mkdir -p "$copy/bin" "$copy/build/replay" "$copy/log"
cp -R Makefile README.md samples man tests "$copy"
under_valgrind() {  # PROGRAM; where standard output is closed the log would be it, so there it runs without
  cat >"$copy/$1" <<END
#!/bin/sh
[ -e /proc/self/fd/1 ] || exec "$PWD/$1" "\$@"
exec valgrind --quiet --leak-check=full --error-exitcode=99 --log-file="$copy/log/%p" "$PWD/$1" "\$@"
END
  chmod +x "$copy/$1"
}
for program in bin/* build/unit build/replay/*; do under_valgrind "$program"; done
SLOWER=20 "$copy/tests/run.sh" "$copy/build/unit" "$copy"/tests/{tools,pipeline/*.sh,faults/{corpus,fields}.sh} >"$copy/says"
tail -n 1 "$copy/says"
runs=$(find "$copy/log" -type f | wc -l)
findings=$(find "$copy/log" -type f -size +0)
[ -z "$findings" ] || xargs head -n 40 <<<"$findings"
echo "$runs runs under valgrind, $(grep -c . <<<"$findings") of them with findings"
[ "$runs" -gt 1000 ] && [ -z "$findings" ]
