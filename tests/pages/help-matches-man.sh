#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The long options that --help prints are those of the page, both ways; and each short one is on the
# page too.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
wrong=0 tools=0
for source in cmd/*.cpp; do
  tool=$(basename "$source" .cpp)
  tools=$((tools + 1))
  page=man/$tool.1
  [ -r "$page" ] || { echo "$tool has no page $page" && wrong=1 && continue; }
  help=$("bin/$tool" --help) || { echo "$tool --help fails" && wrong=1 && continue; }
  # "  -w,--width N   text": the names before the first blank; the page has `.It Fl w , Fl Fl width
  # Ar N`.
  in_help=$(sed -nE 's/^  (-[^ ]+).*/\1/p' <<<"$help" | tr , '\n' | sort -u)
  in_page=$(grep -E '^\.It Fl ' "$page" | grep -oE 'Fl (Fl )?[^ ,]+' | sed -E 's/^Fl Fl /--/; s/^Fl /-/' | sort -u)
  [ "$(wc -l <<<"$in_help")" -ge 3 ] ||
    { echo "$tool --help shows no options that could be read" && wrong=1; }
  only_help=$(comm -23 <(echo "$in_help") <(echo "$in_page") | xargs)
  only_page=$(comm -13 <(echo "$in_help") <(echo "$in_page") | xargs)
  [ -z "$only_help" ] || { echo "$page lacks $only_help" && wrong=1; }
  [ -z "$only_page" ] || { echo "$tool --help lacks $only_page" && wrong=1; }
done
[ "$tools" -gt 0 ] || { echo "no tools in cmd/" && wrong=1; }
exit $wrong
