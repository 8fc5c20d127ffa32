#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One word for one thing: words that are not to come back into what people read (README, pages,
# --help, messages, what the samples print). rolling-fits(7) alone speaks of standard errors, those
# of its estimators.
#
#   a line of numbers is a row, what a sensor recorded in one go a run, one number of it a reading,
#   the line of names the header; a parameter is fixed, not held; p is p.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
PATH=$PWD/bin:$PATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0

# What people read: each text on lines that begin with its name.
texts() {
  local file tool
  for file in README.md lib/README.md tests/README.md samples/README.md samples/*/README.md; do
    sed "s|^|$file: |" "$file"
  done
  for file in man/*.[1-9]; do  # in paragraphs, since words stand on two lines
    awk -v name="$file" '/^\.\\"/ { next } /^\.(Pp|Sh|Ss|It|Bd|Ed|Bl|El)/ { print name ": " text; text = "" } { text = text " " $0 }
      END { print name ": " text }' "$file"
  done
  for tool in cmd/*.cpp; do
    tool=$(basename "$tool" .cpp)
    "$tool" --help | sed "s|^|$tool --help: |"
  done
  # Messages: what stands in quotes in the code, and has blanks.
  grep -noE '"[^"]* [^"]*"' lib/*/*.cpp lib/*/*.h cmd/*.cpp
}
texts >"$scratch/texts"
[ "$(wc -l <"$scratch/texts")" -gt 1000 ] || { echo "only $(wc -l <"$scratch/texts") texts" && wrong=1; }

# never PATTERN INSTEAD [EXCEPT]: no text has it, but those that EXCEPT matches.
never() {
  grep -iE "$1" "$scratch/texts" | grep -vE "${3:-^$}" >"$scratch/found" || return 0
  echo "'$1': say $2"
  cut -c 1-200 "$scratch/found" | head -n 12 | sed 's/^/  /'
  [ "$(wc -l <"$scratch/found")" -le 12 ] || echo "  ... $(wc -l <"$scratch/found") in all"
  wrong=1
}
never '\brecords?\b' 'row, or run' 'records=|lab/records|Cm record|until when to record'
never '\b(names line|line of names)\b' header
never 'standard errors|(its|the|their) standard error\b' 'standard uncertainty; of the stream: standard error output, or stderr' '^man/rolling-fits\.7|rolling-fits\(7\)'
never '\bchance [0-9{]|\bsignificance\b|Ljung-Box p' p
never '\bgiven (numbers|quantities)\b' 'input quantities'
never 'held fixed|both held|\bbe held\b|\bis held\b|are held\b' fixed
never 'held the truth|\bcovered\b' 'coverage probability'
never '\b(is|are|was|were|be) told\b' 'who says what'
never ', of which\b' 'a sentence of its own'
never 'runs that do not are told|no body rolls so|go on as the others|are all of these rows|of negative v|by fainter signs|is (not )?adequate|errors allow for that' 'what was seen and what to do'

# The same words in names and comments of the code, and in the scripts of samples.
grep -nE '' -r lib cmd samples --include='*.h' --include='*.cpp' --include='*.sh' --include='*.awk' --include='*.gp' >"$scratch/texts"
never '(\b|_)records?(\b|_)|Records?\b' 'row, or run'
never '\b(names line|lines? of names)\b' header
never 'significance\b' p
never 'given[ _]numbers' 'input quantities'
never 'held fixed|both_held' fixed

# The look itself finds what it looks for.
printf '%s\n' 'x: three records' 'x: a line of names' 'x: its standard error' 'x: chance 0.1' 'x: b is held' >"$scratch/texts"
found=$(never '\brecords?\b' row; never 'line of names' header; never 'its standard error' s
  never 'chance [0-9]' p; never '\bis held\b' fixed)
[ "$(grep -c '^  x: ' <<<"$found")" = 5 ] || { echo "words pass: $found" && wrong=1; }
exit $wrong
