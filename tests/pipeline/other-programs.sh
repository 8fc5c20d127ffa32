#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What each tool prints with --plain is read by the lines of rolling-columns(5), of those programs
# that are here: as many rows as without --plain, the same names, the same sums of two columns.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
top=$PWD
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0 programs=0
complain() { echo "$*" && wrong=1; }

# A folder for each command, with its plain table roll.tsv and what is to be read of it.
smooth -q --coast -c x samples/CR.csv samples/SR.csv >"$scratch/runs"
body='-K 0.5 -R 0.04' tables=0
while IFS= read -r command; do
  folder=$scratch/$((++tables))
  mkdir "$folder" && cd "$folder" || exit 2
  { eval "$command" >columns && eval "$command --plain" >roll.tsv; } 2>said ||
    complain "$command: $(cat said)"
  ! grep -E '^#|^$' roll.tsv || complain "$command --plain prints such a line"
  awk -F '\t' -v runs="$(grep -c '^## run ' columns)" '
    /^# / { names = substr($0, 3) }
    /^[^#]/ { n++; x += $1; y += $2 }
    END {
      gsub(/\t/, "|", names)
      printf "%d %s%s %.6g %.6g\n", n, names, runs ? "|run" : "", x, y
    }' columns
done >"$scratch/expected" <<END
smooth -w 5 ../runs
differentiate -c x ../runs
differentiate -c v ../runs | shift-from-accel $body
fitpower -q --each $body ../runs
fitpower -q $body ../runs
simulate --v0 0.5 -a 2e-3 -b 0.2 $body
energy-ledger -m 1 -a 2e-3 -b 0.2 $body ../runs
END
[ "$(grep -c '|run ' "$scratch/expected")" -ge 5 ] || complain "few tables of several runs"

# line PROGRAM: what the page says for it.
line() {
  sed -n '/^\.Ss Other programs/,/^\.Ed/p' "$top/man/rolling-columns.5" |
    sed 's/\\(aq/'\''/g; s/\\e/\\/g; s/\\-/-/g' | awk -v program="$1" '
      /^[^ ]/ { on = $1 == program }
      on { sub(/^[^ ]* +/, ""); printf "%s ", $0 }'
}
python() { for python in python3 /usr/bin/python3; do "$python" -c "import $1" 2>/dev/null && break; done; }
# Each prints, for every folder, the number of rows, the names, the sums of the first two columns.
pandas() {
  python pandas || return 77
  "$python" -c "import os, pandas
for i in range(1, $tables + 1):
    os.chdir(f'$scratch/{i}')
    t = $1
    print(len(t), '|'.join(t.columns), *('%.6g' % t.iloc[:, i].sum() for i in (0, 1)))"
}
numpy() {
  python numpy || return 77
  "$python" -c "import os, numpy
for i in range(1, $tables + 1):
    os.chdir(f'$scratch/{i}')
    t = numpy.atleast_1d($1)
    print(len(t), '|'.join(t.dtype.names), *('%.6g' % t[t.dtype.names[i]].sum() for i in (0, 1)))"
}
R() {
  command -v Rscript >/dev/null || return 77
  Rscript --vanilla -e "for (i in 1:$tables) { setwd(file.path('$scratch', i)); t <- $1
    cat(nrow(t), paste(names(t), collapse = '|'), sprintf('%.6g', c(sum(t[[1]]), sum(t[[2]]))))
    cat('\n') }"
}
Julia() {
  command -v julia >/dev/null || return 77
  julia -e "import DelimitedFiles; using Printf
for i in 1:$tables
    cd(joinpath(\"$scratch\", string(i)))
    rows, names = $1
    @printf(\"%d %s %.6g %.6g\n\", size(rows, 1), join(names, \"|\"), sum(rows[:, 1]), sum(rows[:, 2]))
end"
}
gnuplot() {  # with the first two names of the table for those of the page
  type -P gnuplot >/dev/null || return 77
  local i first second
  for ((i = 1; i <= tables; ++i)); do
    cd "$scratch/$i" && IFS=$'\t' read -r first second _ <roll.tsv || return
    command gnuplot 2>said -e "$(sed "s|t\[s\]|$first|; s|v\[m/s\]|$second|; s|plot|set table 'points'; plot|" <<<"$1")" ||
      cat said
    awk -v names="$(head -n 1 roll.tsv | tr '\t' '|')" '
      /^ *[-0-9]/ { n++; x += $1; y += $2 }
      END { printf "%d %s %.6g %.6g\n", n, names, x, y }' points
  done
}
for program in pandas numpy R Julia gnuplot; do
  $program "$(line $program)" >"$scratch/read" 2>&1
  status=$?
  [ $status != 77 ] || continue
  programs=$((programs + 1))
  diff "$scratch/expected" "$scratch/read" || complain "$program reads (>) not what is there (<)"
done
[ $programs -gt 0 ] || { echo 'skipped: no pandas, numpy, R, Julia or gnuplot; make setup check installs one' && exit 77; }
exit $wrong
