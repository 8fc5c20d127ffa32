#!/bin/bash
# Every example of README.md runs and prints what stands there, in the locale EXAMPLES_LOCALE (C).
# `tests/house/readme.sh refresh` writes there what they print today: read the diff.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MFLAGS  # what make says of its own parallel runs is no output of an example
cd "$(dirname "$0")/../.." || exit 2
export PATH="$PWD/bin:$PATH"
readme=$PWD/README.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/run"
cp -r samples "$scratch/run"
cd "$scratch/run" || exit 1

examples=0
inside=0
command=''
: >"$scratch/new"
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
open=0
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
      [ $inside = 1 ] && [ $open = 1 ] && ! absent || echo "$line" >>"$scratch/new" ;;  # what an example prints is made anew
  esac
done <"$readme"
sed -i 's/[[:space:]]*$//' "$scratch/new"  # gnuplot begins with a form feed, and pads its lines
[ $examples -ge 5 ] || { echo "only $examples examples found"; exit 1; }
if [ "${1:-}" = refresh ]; then cp "$scratch/new" "$readme"; else diff -u "$readme" "$scratch/new"; fi
