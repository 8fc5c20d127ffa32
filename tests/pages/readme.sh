#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example of README.md and samples/README.md runs and prints what stands there, in the locale
# EXAMPLES_LOCALE (C). `tests/pages/readme.sh refresh` writes there what they print today: read the
# diff.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MFLAGS  # what make says of its own parallel runs is no output of an example
cd "$(dirname "$0")/../.." || exit 2
export PATH="$PWD/bin:$PATH"
top=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
examples=0
# An example that draws: where there is no gnuplot, what it prints is left as it is.
absent() {
  [[ $command == *gnuplot* || $command == *figures/* || $command == *samples/lab* ]] &&
    ! command -v gnuplot >/dev/null
}
run() {  # the command collected so far, if any
  [ -n "$command" ] || return 0
  if absent; then command=''; return; fi
  LC_ALL=${EXAMPLES_LOCALE:-C} bash -o pipefail -c "$command" >>"$scratch/new" 2>&1 ||
    { echo "exit $? from: $command"; tail -n 3 "$scratch/new"; exit 1; }
  command=''
  examples=$((examples + 1))
}
check() {  # FILE: makes it anew, and compares
  rm -rf "$scratch/run" && mkdir "$scratch/run" && cp -r "$top/samples" "$scratch/run" || exit 1
  cd "$scratch/run" || exit 1
  : >"$scratch/new"
  inside=0 command='' open=0
  while IFS= read -r line; do
    case $line in
      '```'*) run; inside=$((1 - inside)); open=0; echo "$line" >>"$scratch/new" ;;
      '$ '*)
        if [ $inside = 1 ]; then run; command=${line#\$ }; open=1; fi
        echo "$line" >>"$scratch/new" ;;
      *)
        case $command in
          *'|' | *\\) command=$command$'\n'$line; echo "$line" >>"$scratch/new"; continue ;;
        esac
        # What an example prints is made anew.
        [ $inside = 1 ] && [ $open = 1 ] && ! absent || echo "$line" >>"$scratch/new" ;;
    esac
  done <"$1"
  # gnuplot begins with a form feed, and pads its lines; a page has no commit.
  sed -i 's/[[:space:]]*$//; s/^\(## fitpower [0-9.]*\)+[^ ]*/\1/' "$scratch/new"
}
wrong=0
for readme in "$top/README.md" "$top/samples/README.md"; do
  check "$readme"
  if [ "${1:-}" = refresh ]; then cp "$scratch/new" "$readme"; else diff -u "$readme" "$scratch/new" || wrong=1; fi
done
# The first command of README.md builds the tools, where nothing is built yet: make says by which commands.
first=$(sed -n 's/^    \(make setup[^#]*\).*/\1/p' "$top/README.md" | head -n 1)
mkdir "$scratch/source"
(cd "$top" && tar -cf - Makefile cmd lib tests samples man) | tar -xf - -C "$scratch/source" || exit 1
for tool in "$top"/cmd/*.cpp; do
  name=$(basename "$tool" .cpp)
  # shellcheck disable=SC2086  # words
  (cd "$scratch/source" && $first -n) 2>&1 | grep -q -- "-o bin/$name " || { echo "'$first' does not build $name"; wrong=1; }
done
[ $examples -ge 5 ] || { echo "only $examples examples found"; exit 1; }
exit $wrong
