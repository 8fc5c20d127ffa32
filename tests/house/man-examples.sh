#!/bin/bash
# Every example of the manual pages runs, and prints what the page shows (blanks aside). An example
# that ends in `# exits N` must exit with N.
#
#   tests/house/man-examples.sh [PREFIX]     those of the source, or what is installed there
#
# The examples run in the locale EXAMPLES_LOCALE (C).
set -u
export LC_ALL=C
unset CDPATH
overstrike=$(printf '\b')
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it"; exit 77; }

top=$PWD
bin=${1:-$top}/bin pages=(man/*.[1-9])
[[ $# -eq 0 ]] || pages=("$1"/share/man/man?/*.?)
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
export PATH="$bin:$PATH"
failed=0 count=0

# run PAGE COMMAND SHOWN: runs in a fresh copy, as from the top of the checkout; SHOWN is empty if
# the page shows no output.
run() {
  local page=$1 command=$2 shown=$3 status wanted=0
  [[ $command =~ \#\ exits\ ([0-9]+)$ ]] && wanted=${BASH_REMATCH[1]}
  count=$((count + 1))
  rm -rf "$scratch/top" && mkdir "$scratch/top" && cp -R "$top/samples" "$scratch/top/" || exit 2
  (cd "$scratch/top" && LC_ALL=${EXAMPLES_LOCALE:-C} bash -o pipefail -c "$command") \
    </dev/null >"$scratch/out" 2>"$scratch/err"
  status=$?
  if [[ $status -ne $wanted ]]; then
    printf '%s: exit status %d, not %d:\n  $ %s\n' "$page" "$status" "$wanted" "$command"
    sed 's/^/  /' "$scratch/err"
    failed=$((failed + 1))
  elif [[ -n $shown ]] && ! diff -b <(printf '%s' "$shown") <(expand "$scratch/out" "$scratch/err") >"$scratch/diff"; then
    printf '%s: the page shows (<) other output than the command gives (>):\n  $ %s\n' "$page" "$command"
    sed 's/^/  /' "$scratch/diff"
    failed=$((failed + 1))
  fi
}

for page in "${pages[@]}"; do
  command='' shown='' blank='' indent='' continued=0
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
    continued=0
    [[ $command == *\\ ]] && continued=1
  done < <(mandoc -Tascii "$page" | sed "s/.$overstrike//g"; echo .)
done

[[ $count -gt 0 ]] || { echo "no examples found in man/"; exit 1; }
echo "$count examples, $failed failed"
[[ $failed -eq 0 ]]
