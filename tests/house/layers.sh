#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Who may include whom: read from the #include "room/..." lines.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
declare -A may=(
  [base]=''
  [text]='base'
  [signal]='base'
  [selection]='base signal'
  [ode]='base'
  [contact]='base'
  [motion]='base ode contact'
  [noise]='base'
  [least_squares]='base'
  [statistics]='base'
  [fit]='base contact motion noise least_squares statistics'
  [sensor]='base motion'
  [cli]='base text contact signal noise statistics fit'  # signal and noise: what a `##` line says becomes a filter of the noise
  [report]='base text contact selection statistics fit cli'
)
wrong=0 files=0
complain() { echo "$*" && wrong=1; }

for room in lib/*/; do
  room=$(basename "$room")
  [ -n "${may[$room]+known}" ] || { complain "lib/$room: a room without a rule; give it one in $0" && continue; }
  for file in lib/"$room"/*; do
    files=$((files + 1))
    while read -r other; do
      [[ " $room ${may[$room]} " == *" $other "* ]] ||
        complain "$file includes $other/; $room may include: ${may[$room]:-nothing of ours}"
    done < <(sed -nE 's|^ *# *include "([^/"]+)/.*|\1|p' "$file")
    # A file's own room too is named in full.
    bare=$(grep -nE '^ *# *include "[^/]*"' "$file") &&
      complain "$file: an include without its room: $bare"
    case $room in
      cli) ;;
      *) grep -qE '# *include <CLI/' "$file" && complain "$file: only lib/cli knows CLI11" ;;
    esac
    case $room in
      text | cli | report) ;;
      *) grep -qE '# *include <(iostream|fstream|cstdio|stdio\.h|unistd\.h|fcntl\.h)>' "$file" &&
        complain "$file: only lib/text and lib/cli see files"
        option=$(grep -nEo '"([^"\\]|\\.)*"' "$file" | grep -m 1 -e '--[a-z]') &&
          complain "$file: numeric code knows no option: $option" ;;
    esac
    case $room in
      base | ode | fit | sensor | contact | motion | statistics) ;;
      *) grep -qE '# *include (<gsl/|"base/gsl\.h")' "$file" &&
        complain "$file: $room does without GSL" ;;
    esac
  done
done
for file in cmd/*.cpp; do
  files=$((files + 1))
  grep -qE '# *include <(CLI/|gsl/)' "$file" &&
    complain "$file: a command uses CLI11 and GSL through lib/"
done
# No two sources of a module call each other in a loop: tsort puts them in order, or names those of
# a loop. The parts of the class Tool do.
for module in lib/*/; do
  [ "$module" != lib/cli/ ] || continue
  set -- build/"$module"*.o
  [ -e "$1" ] || continue
  loop=$(nm -A "$@" | awk '
    { split($1, file, ":") }
    $2 ~ /^[TR]$/ { home[$3] = file[1] }
    $2 == "U" { calls[file[1], $3] }
    END {
      for (call in calls) {
        split(call, part, SUBSEP)
        if (part[2] in home) print part[1], home[part[2]]
      }
    }' | tsort 2>&1 >/dev/null)
  [ -z "$loop" ] || complain "$loop"
done
[ "$files" -gt 20 ] || complain "only $files files were looked at"
exit $wrong
