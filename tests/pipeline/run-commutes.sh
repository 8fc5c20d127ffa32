#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tool --run N FILE | ... and tool FILE | ... --run N are the same run, byte for byte: files of runs
# one below another and side by side, with numbers in their headers, in their names, or in neither;
# of one file or two, through one tool or two behind it. Of the files a fifth is tried, all with
# LONG=1.
set -u
export LC_ALL=C
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 2
pairs=0 failed=0 turn=0

# A file of runs, in the form that its number says.
make_file() {
  awk -v form="$1" -v many="$2" 'BEGIN {
    if (form == 0)  # side by side
      for (i = 0; i < 5; i++) {
        for (r = 1; r <= many && !i; r++) printf "%sTime (s) Run #%d,v Run #%d", (r > 1 ? "," : ""), 2 * r, 2 * r
        if (!i) print ""
        for (r = 1; r <= many; r++) printf "%s%d,%g", (r > 1 ? "," : ""), i, 9 * r - i / r
        print ""
      }
    else for (r = 1; r <= many; r++) {
      if (r > 1) print (form == 4 ? "," : "")
      if (form == 1) printf "# run of %d\n# t[s]\tv[m/s] Run #%d\n", r, 7 - r
      if (form == 2) printf "## run roll %d\n# remark\n%s", 4 - r, (r == 1 ? "# t[s]\tv[km/h]\n" : "")
      if (form == 3 && r == 1) print "t;v"
      if (form == 4 && r == 1) print "Zeit (s),Tempo (km/h)"
      if (form == 5) print (r == 2 ? "# t[s]\tload" : "# t[s]\tv[m/s]")  # the second lacks v
      for (i = 0; i < 5; i++) printf "%d%s%g\n", i, (form == 3 ? ";" : form == 4 ? "," : "\t"), 9 * r - i / r
    }
    if (form > 0) print "# behind them"
  }'
}

same() {  # LEFT RIGHT: two pipelines print the same and end with the same status
  local left right
  left=$(set -o pipefail; eval "$1" 2>/dev/null; echo "status $?")
  right=$(set -o pipefail; eval "$2" 2>/dev/null; echo "status $?")
  pairs=$((pairs + 1))
  case $left in *'status 0') worked=$((worked + 1)) ;; esac
  # What a refusal has printed before it is not compared.
  [ "$left" = "$right" ] || { [[ $left != *'status 0' ]] && [[ $right != *'status 0' ]]; } ||
    { echo "$1"; echo "$2"; diff <(echo "$left") <(echo "$right"); failed=$((failed + 1)); }
}

worked=0
for form in 0 1 2 3 4 5; do
  for many in 1 3; do
    make_file $form $many >a.csv
    make_file $form 2 >'b 5'
    for n in 1 2 4 6; do
      for files in a.csv "'b 5'" "a.csv 'b 5'"; do
        turn=$(((turn + 1) % 5))
        [ $turn = 1 ] || [ -n "${LONG:-}" ] || continue
        same "smooth -w 1 --run $n $files | differentiate" "smooth -w 1 $files | differentiate --run $n"
        same "differentiate --run $n $files | smooth -w 3 | shift-from-accel -K .5 -R .04" \
          "differentiate $files | smooth -w 3 | shift-from-accel -K .5 -R .04 --run $n"
        same "smooth -w 1 --run $n $files | differentiate --run $n" "smooth -w 1 $files | differentiate --run $n"
      done
    done
  done
done
echo "$pairs pairs of pipelines, $worked of them with rows, $failed that differ"
[ "$failed" = 0 ] && [ "$worked" -gt $((pairs / 8)) ]
