#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example of the manual pages runs, and prints what the page shows (blanks aside). An example
# that ends in `# exits N` must exit with N. The examples of a page run one after the other in one
# folder, a copy of the top of the checkout with the samples alone: a file that one makes, the next
# may read.
#
#   tests/pages/man-examples.sh [PREFIX]     those of the source, or what is installed there
#   tests/pages/man-examples.sh refresh      writes into the pages what they print today: read the diff
#
# The examples run in the locale EXAMPLES_LOCALE (C).
set -u
export LC_ALL=C
unset CDPATH
overstrike=$(printf '\b')
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it"; exit 77; }

refresh=0
[[ ${1:-} != refresh ]] || { refresh=1; shift; }
top=$PWD
bin=${1:-$top}/bin pages=(man/*.[1-9])
[[ $# -eq 0 ]] || pages=("$1"/share/man/man?/*.?)
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
export PATH="$bin:$PATH"
failed=0 count=0

# refresh PAGE COMMAND: puts the lines of $scratch/out, columns aligned, in the place of those of
# $scratch/shown, which follow the command. Blanks aside, a line of the source is the shown one with
# its escapes.
refresh() {
  local columns
  columns=$(awk -F '\t' '
    FNR == NR { for (i = 1; i <= NF; ++i) if (NF > 1 && length($i) > width[i]) width[i] = length($i); next }
    { for (i = 1; i < NF; ++i) printf "%-" width[i] + 2 "s", $i; print $NF }' "$scratch/out" "$scratch/out")
  printf '%s\n' "$columns" | sed 's/\\/\\e/g; s/\^/\\(ha/g; s/'\''/\\(aq/g; s/^[.]/\\\&./' >"$scratch/new"
  FIRST_LINE=${2%%$'\n'*} awk -v new="$scratch/new" '
    function plain(line) {
      gsub(/\\\(ha/, "^", line); gsub(/\\\(aq/, "\047", line); gsub(/\\-/, "-", line); gsub(/\\&/, "", line)
      gsub(/\\e/, "\\", line); gsub(/[ \t]+/, " ", line); sub(/ $/, "", line)
      return line
    }
    FILENAME != ARGV[2] { shown[++lines] = plain($0); next }
    { source[++count] = $0 }
    END {
      for (at = 1; at <= count && plain(source[at]) != "$ " plain(ENVIRON["FIRST_LINE"]); ++at) print source[at]
      for (; at <= count; ++at) {
        for (same = 0; same < lines && plain(source[at + same]) == shown[same + 1]; ++same) continue
        if (same == lines) break
        print source[at]
      }
      while (at <= count && (getline line <new) > 0) print line
      for (at += lines; at <= count; ++at) print source[at]
    }' "$scratch/shown" "$1" >"$scratch/page" && cp "$scratch/page" "$1"
}

# Whether a command draws where there is no gnuplot, or runs a script of the samples, which calls the
# tools by their plain names, where they are installed under others.
absent() {
  [[ $1 == *samples/figures/* || $1 == *gnuplot* ]] && ! command -v gnuplot >/dev/null ||
    [[ $1 == *samples/*.sh* && ! -x $bin/smooth ]]
}

# run PAGE COMMAND SHOWN: SHOWN is empty if the page shows no output.
run() {
  local page=$1 command=$2 shown=$3 status wanted=0
  absent "$command" && return
  [[ $command =~ \#\ exits\ ([0-9]+)$ ]] && wanted=${BASH_REMATCH[1]}
  count=$((count + 1))
  (cd "$scratch/top" && LC_ALL=${EXAMPLES_LOCALE:-C} bash -o pipefail -c "$command") \
    </dev/null >"$scratch/out" 2>"$scratch/err"
  status=$?
  sed -i 's/^\(## fitpower [0-9.]*\)+[^ ]*/\1/' "$scratch/out"  # a page has no commit
  if [[ $status -ne $wanted ]]; then
    printf '%s: exit status %d, not %d:\n  $ %s\n' "$page" "$status" "$wanted" "$command"
    sed 's/^/  /' "$scratch/err"
    failed=$((failed + 1))
  elif [[ -n $shown ]] && ! diff -b <(printf '%s' "$shown") <(expand "$scratch/out" "$scratch/err") >"$scratch/diff"; then
    if [[ $refresh -eq 1 ]]; then
      cat "$scratch/err" >>"$scratch/out"
      printf '%s' "$shown" >"$scratch/shown"
      refresh "$page" "$command"
      return
    fi
    printf '%s: the page shows (<) other output than the command gives (>):\n  $ %s\n' "$page" "$command"
    sed 's/^/  /' "$scratch/diff"
    failed=$((failed + 1))
  fi
}

for page in "${pages[@]}"; do
  command='' shown='' blank='' indent='' continued=0
  rm -rf "$scratch/top" && mkdir "$scratch/top" && cp -R "$top/samples" "$scratch/top/" || exit 2
  while IFS= read -r line; do
    text=${line#"${line%%[! ]*}"}
    if [[ $continued -eq 1 ]]; then
      command+=$'\n'$text
    elif [[ $text == '$ '* ]]; then
      [[ -n $command ]] && run "$page" "$command" "$shown"
      command=${text#'$ '} shown='' blank='' indent=${line%%[! ]*}
    elif [[ -z $text ]]; then  # the break between two runs, or the end of the output
      blank+=$'\n'
      continue
    elif [[ -n $command && $line == "$indent"* ]]; then
      shown+=$blank$text$'\n' blank=''
      continue
    else
      [[ -n $command ]] && run "$page" "$command" "$shown"
      command=''
      continue
    fi
    continued=0  # the command goes on where it ends with a backslash, or is not yet whole
    [[ $command == *\\ ]] || ! bash -n -c "$command" 2>/dev/null && continued=1
  done < <(mandoc -Tascii "$page" | sed "s/.$overstrike//g"; echo .)
done

[[ $count -gt 0 ]] || { echo "no examples found in man/"; exit 1; }
echo "$count examples, $failed failed"
[[ $failed -eq 0 ]]
