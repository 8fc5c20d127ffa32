#!/bin/bash
# samples/lab: `make` goes from the records to the table, the joint law and the figure, and does again
# only what has changed; `make check` fails where a v^b is not the law of a record, where the records
# disagree or the energy does not balance; live.sh draws while a record comes, from a terminal line
# and from a file that grows.
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

# Five rolls of one cylinder on one mat, as the README of this folder makes them.
../fleet/make.sh records 5 0
make >said 2>&1 || complain "make: $(cat said)"
[ "$(tail -n 1 said)" = '# the records have one law, as far as they tell' ] ||
  complain "make says $(cat said)"
[ "$(cut -f 1 results/table.txt | xargs)" = '# record 0001 0002 0003 0004 0005' ] ||
  complain "the table: $(cat results/table.txt)"
grep -q '^</svg>' results/fig4.svg || complain 'no figure'
# a and b are those that made the records, and P is that of chi2 with 8 degrees of freedom.
awk '!/^#/ {
    h = $9 / 2
    P = exp(-h) * (1 + h + h^2 / 2 + h^3 / 6)
    exit !(($1 - 1.87e-3)^2 < 16 * $2^2 && ($3 - 0.215)^2 < 16 * $4^2 && $10 == 8 &&
      ($11 - P)^2 < 4e-4 * P^2) }' results/joint.txt || complain "joint: $(cat results/joint.txt)"
make check >said 2>&1 || complain "make check: $(cat said)"

# No records, or a path that make would take apart: one line says so, and clean needs none.
for folder in /nonexistent "$scratch/of two words"; do
  mkdir -p "$scratch/of two words" && cp records/0001.csv "$scratch/of two words"
  make records="$folder" >said 2>&1 && complain "make took the records of $folder"
  grep -q "no \*.csv in '$folder': say records=/PATH/OF/THE/FOLDER" said && [ "$(wc -l <said)" = 1 ] ||
    complain "$folder: $(cat said)"
done
make -n clean records=/nonexistent >said 2>&1 || complain "make clean: $(cat said)"

# Another K on the command line: a is larger by 1.83/1.5, b the same; and back.
law() { awk '!/^#/ { print $1, $3 }' results/joint.txt; }
before=$(law)
make -s K=0.83 >said 2>&1 || complain "make K=0.83: $(cat said)"
awk '{ exit !(($3 / $1 * 1.5 / 1.83 - 1)^2 < 1e-6 && ($4 - $2)^2 < 1e-6) }' <<<"$before $(law)" ||
  complain "with K = 0.83 the law is $(law), with 0.5 $before"
make -s >said 2>&1 || complain "make: $(cat said)"
[ "$(law)" = "$before" ] || complain "with K = 0.5 again the law is $(law), before $before"
make check >said 2>&1 || complain "make check: $(cat said)"

# Only what has changed: of five records one, the table, the joint law, the figure.
[ "$(make -n | grep -vc '^awk')" = 0 ] || complain "make would do again: $(make -n)"
touch -d '+2 seconds' records/0003.csv
redone=$(make -n 2>/dev/null | grep -oE '>results/[a-z0-9]+\.[a-z0-9]+' | sort | xargs)
[ "$redone" = '>results/0003.fit >results/fig4.svg >results/joint.txt >results/table.txt' ] ||
  complain "after a change of one record make does $redone"

# Speeds instead of positions, of another body.
mkdir speeds
for run in CF CR; do cut -d, -f1,3 ../$run.csv >speeds/$run.csv; done
rm -rf results
make records=speeds column=v >said 2>&1
grep -q 'NOT one law' said || complain "two mats: $(cat said)"
make records=speeds column=v check >said 2>&1 && complain 'check: two mats agree'
# A wrong law: the energy does not balance.
sed 's/0\.001[0-9]*/0.0025/' results/CR.fit >results/wrong.fit
./check.sh -c v speeds/CR.csv results/CR.fit >said 2>&1 || complain "check of CR: $(cat said)"
./check.sh -c v speeds/CR.csv results/wrong.fit >said 2>&1
[ $? = 1 ] && grep -q 'the check does not hold' said || complain "a wrong law: $(cat said)"
# Another law, D = 0.5 mm + 4 mm (v/(m/s))^2: no a v^b describes its roll, whatever the energy says.
awk 'BEGIN { print "# v D"; for (i = 0; i <= 60; i++) print i / 100, 5e-4 + 4e-3 * (i / 100)^2 }' |
  simulate --law - -K 0.5 -R 0.04 --v0 0.5 --sensor pasco --seed 3 >other
../fleet/fit.sh other >other.fit 2>said
./check.sh other other.fit >said 2>&1 && complain 'check: D = 0.5 mm + 4 mm v^2 is a v^b'
grep -q 'fitpower: .*a v^b' said || complain "another law: $(cat said)"

# live.sh: a picture for every record but the last six: five wait for their window to be whole, one
# for the difference with the next. A record comes at its own pace through a pseudo terminal.
record() { awk 'BEGIN { for (i = 0; i < 30; i++) printf "%.2f %.4f\n", i / 25, 0.5 - 0.008 * i }'; }
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
record >whole
head -n 20 whole >grows
./live.sh -T dumb grows >drawn 2>&1 &
live=$!
await drawn 14
tail -n 10 whole >>grows
await drawn 24
kill $live
wait $live 2>/dev/null
if script -qec 'test -t 2' /dev/null </dev/null >/dev/null 2>&1; then
  {
    while IFS= read -r line; do echo "$line"; sleep 0.04; done <whole
    await typed 24 >said
    kill "$(cat pid)"
  } | timeout 20 bash -c 'echo $$ >pid; exec script -qfec "./live.sh -T dumb -" typed' >/dev/null 2>&1
  ! grep -q instead said || complain "in a terminal: $(cat said)"
fi
exit $wrong
