#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Nothing in the environment changes what the scripts, the pages and the README give: a locale with
# a decimal comma, CDPATH, folders and runs whose names have blanks, quotes, signs of the shell.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
export PATH="$PWD/bin:$PATH"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# Each script sets the locale and CDPATH before its first other command, or sources draw.sh.
first=$'\nexport LC_ALL=C\nunset CDPATH'
for script in cmd/install/*.sh samples/*.sh samples/*/*.sh tests/run.sh tests/bench/*.sh; do
  start=$(grep -v '^#' "$script" | head -n 3)
  [[ $start == 'set -'*"$first" || $start == *'/draw.sh"'* || $script == */script.sh || $script == */scratch.sh ]] ||
    complain "$script does not begin with set, LC_ALL and CDPATH"
done

localedef -i de_DE -f UTF-8 "$scratch/de_DE.UTF-8" 2>/dev/null || {
  [ $wrong = 0 ] || exit 1
  echo "skipped: no locale with a decimal comma (package locales, which has localedef's sources)"
  exit 77
}
export LOCPATH=$scratch
comma=$(printf '1,5\n' | LC_ALL=de_DE.UTF-8 awk '{ print $1 * 2 }')
[ "$comma" = 3 ] || echo "(this awk does not obey the locale: it makes $comma of twice 1,5)"

# The scripts, once in plain surroundings and once in hostile ones; each leaves its files in $1.
all_scripts() {
  local out=$1 samples=$2 name
  "$samples/table1.sh" >"$out/table1"
  mkdir "$out/exports" && "$samples/exports/make.sh" "$out/exports"
  if command -v gnuplot >/dev/null; then
    for name in ${LONG:+fig1 fig2 fig3 fig5 energy fig1-stop turn} fig4; do
      "$samples/figures/$name.sh" >"$out/$name.svg"
    done
    if [ -n "${LONG:-}" ]; then
      "$samples/paper.sh" >"$out/paper"
      "$samples/report.sh" "$out" >"$out/report.html"
      sed -i '/<h2>How exact/,$d' "$out/report.html"  # it ends with a table of run times
    fi
  fi
  mkdir "$out/runs"
  cp "$samples/CR.csv" "$out/runs/a&b;touch hit;\$(touch hit)\`touch hit\`'\"\\t x.csv"
  cp "$samples/CR.csv" "$out/runs/#h.csv"
  "$samples/lab/lab.sh" -K 0.5 -R 0.04 -o "$out/results" "$out/runs"
}
odd="$scratch/o d'd\"&;\$(touch hit)\`touch hit\`"
mkdir "$scratch/plain" "$odd" "$odd/out" "$odd/tmp"
cp -R samples "$odd/samples"
(cd "$scratch" && HOME=$scratch all_scripts "$scratch/plain" "$OLDPWD/samples") 2>"$scratch/said" ||
  complain "the scripts: $(cat "$scratch/said")"
(cd "$odd" && export CDPATH=.:.. HOME=$scratch LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 &&
  export TMPDIR="$odd/tmp" && all_scripts out samples) 2>"$scratch/said" ||
  complain "in odd surroundings: $(cat "$scratch/said")"
diff -r "$scratch/plain" "$odd/out" | cut -c 1-300 | head -n 40 | grep . &&
  complain "the scripts give something else in odd surroundings"
table=$scratch/plain/results/table.txt
[ "$(grep -vc '^#' "$table")" = 2 ] || complain "not a row for each run: $(cut -f 1 "$table")"
[ "$(awk -F'\t' '!/^##/ { print NF }' "$table" | sort -u | wc -l)" = 1 ] ||
  complain "a name makes a column"
[ ! -e hit ] && [ -z "$(find "$scratch" -name hit)" ] || complain "a name was run as code"

# The README, and with LONG=1 the pages, pasted into a terminal of that locale.
for examples in ${LONG:+tests/pages/man-examples.sh} tests/pages/readme.sh; do
  EXAMPLES_LOCALE=de_DE.UTF-8 LOCPATH=$scratch $examples >"$scratch/said" 2>&1 || [ $? = 77 ] ||
    { complain "$examples in de_DE.UTF-8:" && tail -n 60 "$scratch/said"; }
done
exit $wrong
