#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# samples/lab: lab.sh goes from the runs to the table, the joint law and the figure, whatever the files
# are called and whatever was there before; --check fails if a v^b is not the law of a run, if the runs
# disagree or the energy does not balance; live.sh draws while a run comes, from a terminal line and
# from a file that grows.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
command -v gnuplot >/dev/null ||
  { echo "skipped: no gnuplot; make setup check installs it"; exit 77; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
mkdir "$scratch/bin"
for tool in bin/*; do ln -s "$PWD/$tool" "$scratch/bin"; done
cp -R samples "$scratch"
cd "$scratch/samples/lab" || exit 2

# Most of the runs below are without a figure, which takes most of the time: with all programs but gnuplot.
mkdir "$scratch/programs"
IFS=: read -ra folders <<<"$PATH"
for folder in "${folders[@]}"; do ln -s "$folder"/* "$scratch/programs" 2>/dev/null; done
rm -f "$scratch/programs/gnuplot"

of_body='-K 0.5 -R 0.04 -m 1.375'
drawn() { ./lab.sh "$@" >said 2>&1; }
lab() { PATH=$scratch/programs drawn "$@"; }
runs() { cut -f "$(grep '^# ' results/table.txt | tr '\t' '\n' | grep -n '^run$' | cut -d: -f1)" \
  <(grep -v '^##' results/table.txt) | grep -v '^run$'; }
law() { awk '!/^#/ { print $1, $3 }' results/joint.txt; }

# Five rolls of one cylinder on one mat, as the README of this folder makes them.
mkdir runs
for seed in 101 102 103 104 105; do
  simulate --scene ../CR.toml --sensor pasco --seed $seed >runs/$seed.csv
done
# shellcheck disable=SC2086  # words
drawn --check $of_body runs || complain "check: $(cat said)"
grep -qx 'passed: 5 runs' said || complain "no word of it: $(cat said)"
[ "$(runs | xargs)" = '101.csv 102.csv 103.csv 104.csv 105.csv' ] ||
  complain "the table: $(cat results/table.txt)"
grep -q '^</svg>' results/fig4.svg || complain 'no figure'
# a and b are those that made the runs, and p is that of chi2 with 8 degrees of freedom.
awk '!/^#/ {
    h = $9 / 2
    p = exp(-h) * (1 + h + h^2 / 2 + h^3 / 6)
    exit !(($1 - 1.87e-3)^2 < 16 * $2^2 && ($3 - 0.215)^2 < 16 * $4^2 && $10 == 8 &&
      ($11 - p)^2 < 4e-4 * p^2) }' results/joint.txt || complain "joint: $(cat results/joint.txt)"
[ "$(grep -vc '^#' results/energy.txt)" = 5 ] || complain "energy: $(cat results/energy.txt)"

# The energy of a good run adds up at other rates too: the window is one in seconds.
for rate in 10 100; do
  mkdir "at$rate"
  for seed in 1 2 3; do
    simulate --scene ../CR.toml --sensor pasco --rate $rate --seed $seed >"at$rate/$seed.csv"
  done
  # shellcheck disable=SC2086
  lab --check $of_body "at$rate" || complain "$rate rows a second: $(cat said)"
done

# What rolled is not guessed.
lab runs && complain 'lab.sh goes on without K and R'
grep -q 'lab.sh: say what rolled: -K 0.5 -R 0.04' said || complain "no K: $(cat said)"
lab -K 0.5 -R 0.04 /nonexistent && complain 'lab.sh took the runs of /nonexistent'
grep -q "lab.sh: there is no run to be fitted" said || complain "no folder: $(cat said)"

# Names of files, in a folder with a blank, are names: each is a run, with the law of its numbers, and
# none is code. A run that is added, replaced or removed is so in the table and in the joint law.
odd="$scratch/of two words"
mkdir "$odd"
number=0
for name in 'a b.csv' "Ann's.csv" 'C&S.CSV' 'run(1).csv' 'a:b.csv' 'r;>pwned;.csv' '-K.csv' \
  '$(touch pwned).csv' '`touch pwned`.txt' '#1.csv' '%s.csv' 'a\b.csv' '*.csv' 'ü.csv' 'a=b.csv' \
  '~.csv' '!.csv' '{a,b}.csv' '|x.csv' '<y.csv' '[z].tsv' '--help.csv' '$K.csv'; do
  number=$((number % 5 + 1))
  cp "runs/10$number.csv" "$odd/$name"
done
echo 'nothing of a run' >"$odd/notes.md"
echo 'nothing of a run' >"$odd/notes.txt"
drawn -K 0.5 -R 0.04 "$odd" || complain "odd names: $(cat said)"
for notes in notes.md notes.txt; do
  grep -q "lab.sh: passed over: $notes: smooth: " said || complain "$notes is not named: $(cat said)"
done
find "$scratch" -name 'pwned*' | grep . && complain 'the name of a file is code'
rm "$odd"/notes.*
[ "$(runs | tr -d '"' | sort)" = "$(cd "$odd" && printf '%s\n' *.csv *.CSV *.t?? | sort)" ] ||
  complain "odd names: $(runs)"
rm "$odd/-K.csv"
cp runs/102.csv "$odd/a b.csv"
lab -K 0.5 -R 0.04 "$odd" || complain "one less: $(cat said)"
runs | grep -qx -- '-K.csv' && complain 'a run that was removed is in the table'
[ "$(awk '!/^#/ { print $8 }' results/joint.txt)" = 22 ] || complain 'a removed run is in the joint law'
a() { awk -F '\t' -v run="$1" '$NF == run { print $1 }' results/table.txt; }
[ -n "$(a 'a b.csv')" ] && [ "$(a 'a b.csv')" = "$(a "Ann's.csv")" ] ||
  complain 'a run that was replaced has its old law'

echo 'nothing of a run' >notes.md
mkdir class
cp runs/10[123].csv notes.md class
lab --check -K 0.5 -R 0.04 class || complain "notes fail the check: $(cat said)"
# A table without a run fails the check, unless it is accepted.
for table in empty.csv binary.csv start.txt frames.csv; do
  case $table in
    empty.csv) : >"class/$table" ;;
    binary.csv) head -c 300 /bin/sh >"class/$table" ;;
    start.txt) head -n 30 runs/101.csv >"class/$table" ;;
    frames.csv) sed '1s/Time (s)/Frame/' runs/101.csv >"class/$table" ;;
  esac
  lab --check -K 0.5 -R 0.04 class && complain "$table passes: $(cat said)"
  grep -qF "lab.sh: $table: no run was found in this table" said || complain "$table is not named: $(cat said)"
  lab --check --accept $table -K 0.5 -R 0.04 class || complain "$table fails, though accepted: $(cat said)"
  grep 'no run of this name' said && complain "$table is sought among the runs"
  rm "class/$table"
done

# A name with a blank is one name: it does not accept the file that is called like its end.
: >class/b.csv
lab --check --accept 'a b.csv' -K 0.5 -R 0.04 class && complain "'a b.csv' accepts b.csv: $(cat said)"
rm class/b.csv

# Two bodies, up and down a mat that is not level: one law, with a K for each and the slope fitted.
mkdir two
i=0
for K in 0.5 0.83; do
  for slope in 0.001 -0.001; do
    i=$((i + 1))
    simulate -K $K -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5 --slope $slope --sensor pasco --seed $i |
      awk -F, -v OFS=, -v down=$((i % 2 == 0)) \
        'down && NR > 1 && $2 != "" { $2 = 2 - $2 } { print $1, $2 }' >two/$i.csv
  done
done
bodies='-K 0.5,0.5,0.83,0.83 -R 0.04'
# shellcheck disable=SC2086  # words, here and below
lab $bodies --slope fit two || complain "two bodies: $(cat said)"
awk '!/^#/ { exit !($11 > 0.01 && ($1 - 1.87e-3)^2 < 16 * $2^2) }' results/joint.txt ||
  complain "two bodies: $(cat said results/joint.txt)"
lab -K 0.5 -R 0.04 two
grep -q 'fitpower: the runs disagree .* is furthest from the others' said || complain "one K for two bodies: $(cat said)"
echo none >two/5.csv
lab $bodies two && complain 'a run is missing, and the K of the others is guessed'
rm two/5.csv
# A check with a K and a mass for each on a mat that is not level; the second is accepted.
drawn --check $bodies -m 1.0,1.0,2.0,2.0 --accept 2.csv --slope 0.001 two || complain "check of two bodies: $(cat said)"
law >of-files && cp results/fig4.svg of-files.svg
grep -q 'slope 0.001;' of-files.svg || complain 'the figure has no slope'
paste <(grep -v '^#' results/energy.txt) <(awk -F '\t' '!/^#/ { print $8 }' results/table.txt) |
  awk -F '\t' 'BEGIN { split("0.75 0.75 1.83 1.83", half, " ") }
    { E = half[NR] * $9^2; if (($1 - E)^2 > 1e-3 * E^2 || ($4 - ($3 - ($1 - $2 - $8)) / ($1 - $2 - $8))^2 > 1e-5) exit 1 }
    END { exit NR != 4 }' || complain "energies of two bodies: $(cat results/energy.txt)"
lab --check -K 0.5,0.83,0.5,0.83 -R 0.04 --slope 0.001 two && complain 'check: the K of two bodies are exchanged'
# The same runs in one file are the same runs.
awk -v OFS=, 'FNR == 1 && NR > 1 { print "" } { print }' \
  two/1.csv two/2.csv two/3.csv two/4.csv >all.csv
lab $bodies --slope 0.001 all.csv || complain "four runs in a file: $(cat said)"
law | cmp - of-files || complain "four runs in a file have another law: $(cat said)"

# A column that has a name of its own, as the table and as the figure say; and the slope is in it.
mkdir named
for i in 1 2 3 4; do sed '1s/.*/Time (s),Ort/' two/$i.csv >named/$i.csv; done
lab $bodies --slope 0.001 named && complain 'Ort is taken for x'
drawn $bodies --slope 0.001 --use x=Ort named/?.csv || complain "--use x=Ort: $(cat said)"
law | cmp - of-files && cmp results/fig4.svg of-files.svg || complain "--use x=Ort: $(cat said)"
# Two of them, one with a unit.
for i in 1 2 3 4; do awk -F, -v OFS=, 'NR == 1 { print "Zeitpunkt", "Ort"; next } { print 1000 * $1, $2 }' two/$i.csv >named/$i.csv; done
lab $bodies --slope 0.001 --use 't=1[ms]' --use x=Ort named/?.csv || complain "use of two: $(cat said)"
law | cmp - of-files || complain "use of two: $(cat said)"

# A run that is known to be off may be accepted.
mkdir off
for seed in 101 102 103 104; do cp runs/$seed.csv off; done
simulate --scene ../CR.toml -a 2e-3 --sensor pasco --seed 105 >off/105.csv
lab --check $of_body off && complain 'check: a run that is off'
[ "$(tail -n 1 said)" = 'lab.sh: failed: see the lines above' ] || complain "the last line of a check that fails: $(cat said)"
lab --check $of_body --accept 105.csv off || complain "--accept of a run that is off: $(cat said)"
grep -q 'accepted: the runs disagree .*: run 105.csv is furthest from the others' said || complain "accepted: $(cat said)"
lab --check $of_body --accept 104.csv off && complain 'check: another run is accepted'
# A folder without a file, and too many K.
mkdir empty
lab -K 0.5 -R 0.04 empty && complain 'lab.sh took an empty folder'
[ "$(cat said)" = 'lab.sh: there is no run to be fitted' ] || complain "an empty folder: $(cat said)"
lab -K 0.5,0.83 -R 0.04 off && complain 'two K of five runs'
[ "$(tail -n 1 said | cut -c 1-52)" = 'fitpower: --shape-factor gives 2 values for 5 runs: ' ] || complain "two K: $(cat said)"
# Speeds instead of positions; two mats have no one law.
mkdir speeds
for run in CF CR; do cut -d, -f1,3 ../$run.csv >speeds/$run.csv; done
lab --check -K 0.5 -R 0.04 -c v speeds && complain 'check: two mats agree'
grep -q 'fitpower: the runs disagree' said || complain "check: two mats: $(cat said)"
# Another law, D = 0.5 mm + 4 mm (v/(m/s))^2: no a v^b describes its roll.
mkdir other
awk 'BEGIN { print "# v D"; for (i = 0; i <= 60; i++) print i / 100, 5e-4 + 4e-3 * (i / 100)^2 }' |
  simulate --law - -K 0.5 -R 0.04 --v0 0.5 --sensor pasco --seed 3 >other/run.csv
cp -R other ./-x
lab --check $of_body -- -x && complain 'check: D = 0.5 mm + 4 mm v^2 is a v^b'
grep -q 'fitpower: run run.csv: D = d0 + d2 v^2 is better' said || complain "check: D = 0.5 mm + 4 mm v^2: $(cat said)"
[ "$(runs)" = run.csv ] || complain "the name of one run: $(runs)"
# Whoever has looked at it may accept it.
lab --check --accept run.csv $of_body other || complain "--accept: $(cat said)"
# Of speeds the energy alone decides: here it is open by 8 %, and with 1 mm (v/(m/s))^2 by 4 %.
lab --check $of_body -c v other && complain 'check: an energy that is open by 8 %'
grep -q 'energy-ledger: run run.csv: the check does not hold' said || complain "an open energy: $(cat said)"
awk 'BEGIN { print "# v D"; for (i = 0; i <= 60; i++) print i / 100, 5e-4 + 1e-3 * (i / 100)^2 }' |
  simulate --law - -K 0.5 -R 0.04 --v0 0.5 --sensor pasco --seed 3 >other/run.csv
lab --check $of_body -c v other || complain "an energy that is open by 4 %: $(cat said)"

# live.sh: a picture for every row but the last six: five wait for their window to be whole, one
# for the difference with the next. A row comes at its own pace through a pseudo terminal.
row() { awk 'BEGIN { for (i = 0; i < 30; i++) printf "%.2f %.4f\n", i / 25, 0.5 - 0.008 * i }'; }
pictures() { grep -ac 'v / (m/s)' "$1" 2>/dev/null || :; }
await() {  # FILE PICTURES: so many have come, and no more do
  local i
  for ((i = 0; i < 200; i++)); do
    [ -e "$1" ] && [ "$(pictures "$1")" -ge "$2" ] && break
    sleep 0.05
  done
  sleep 0.3
  [ "$(pictures "$1")" = "$2" ] || complain "live: $(pictures "$1") pictures instead of $2"
}
row >whole
head -n 20 whole >grows
./live.sh -T dumb grows >said 2>&1 && complain 'live.sh goes on without K and R'
grep -q 'say what rolled' said || complain "live.sh without K: $(cat said)"
./live.sh -K 0.5 -R 0.04 -T dumb grows >drawn 2>&1 &
live=$!
await drawn 14
tail -n 10 whole >>grows
await drawn 24
kill $live
wait $live 2>/dev/null
for ((i = 0; i < 60; i++)); do pgrep -f '^tail .*-F -- grows$' >/dev/null || break; sleep 0.05; done
[ $i -lt 60 ] || complain 'live.sh leaves a tail behind'
if script -qec 'test -t 2' /dev/null </dev/null >/dev/null 2>&1; then
  {
    while IFS= read -r line; do echo "$line"; sleep 0.04; done <whole
    await typed 24 >said
    kill "$(cat pid)"
  } | timeout 20 bash -c 'echo $$ >pid; exec script -qfec "./live.sh -K 0.5 -R 0.04 -T dumb -" typed' >/dev/null 2>&1
  ! grep -q instead said || complain "in a terminal: $(cat said)"
fi
exit $wrong
