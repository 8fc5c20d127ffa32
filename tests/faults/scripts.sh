#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No script harms what it did not make. Each script of samples and cmd/install runs in a tree with
# files of somebody's own, and beside what it made before: without a folder for scratch files, with
# operands that mean nothing, ended in the middle, in a folder that cannot be written, on a full disk.
# Afterwards the tree, and what was made before, are byte for byte what they were, and no scratch is
# left. The disks and the folders that cannot be written are mounts of a namespace of this test's own;
# where that cannot be had, they are left out.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
if [ -z "${mounts-}" ] && unshare -rm true 2>/dev/null; then mounts=own exec unshare -rm "$0"; fi
scratch=$(mktemp -d) || exit 2
trap 'umount -q "$scratch"/*/ 2>/dev/null; rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

tree="$scratch/a thesis" made=$scratch/made
mkdir -p "$tree/results" "$tree/runs" "$tree/figures" "$tree/bin" "$scratch/tmp" "$scratch/path" "$made"
cp -R samples cmd man Makefile README.md LICENSE "$tree"
ln -s "$PWD"/bin/* "$tree/bin"
echo 'years of work' | tee "$tree/thesis.tex" "$tree/results/"{table.txt,mine,index.html,capstone.csv} >/dev/null
cp samples/CR.csv "$tree/runs/first.csv"
cp samples/CF.csv "$tree/results/second.csv"
ln -s "$made" "$tree/build"
: >"$scratch/file"
# Programs that are quick to strip and to pack, and a machine where nothing can be installed.
mkdir "$scratch/tools" && for tool in bin/*; do cp "$(type -P true)" "$scratch/tools/${tool#bin/}"; done
for stand_in in dpkg-query apt-get; do printf '#!/bin/sh\nexit 1\n' >"$scratch/path/$stand_in"; done
chmod +x "$scratch/path/"*
awk 'BEGIN { print "t[s],v[km/h]"; for (t = 0; t <= 60; t += 0.5) print t "," 100 - t }' >"$tree/runs/car"
export TMPDIR="$scratch/tmp" SOURCE_DATE_EPOCH=1600000000 XZ_OPT=-0 DPKG_DEB_COMPRESSOR_LEVEL=0 \
  bindir=/b mandir=/m datadir=/d docdir=/o TOOLS="$scratch/tools"
cp -R "$tree" "$tree.before"

# attempt FAULT COMMAND...: in the tree, within a minute; what the command says is in $scratch/out.
attempt() {
  local fault=$1
  shift
  (cd "$tree" && timeout 60 "$@") </dev/null >"$scratch/out" 2>&1
  status=$?
  [ $status != 124 ] || complain "$fault: does not end: $*"
  for place in tmp full; do
    [ -z "$(ls -A "$scratch/$place")" ] || { complain "$fault leaves scratch: $*" && rm -rf "${scratch:?}/$place"/*; }
  done
}
# unharmed FOLDER WORDS...: it is as it was.
unharmed() {
  diff -r --no-dereference "$1.before" "$1" >"$scratch/harm" ||
    { complain "harm by ${*:2}: $(head -n 5 "$scratch/harm")" && exit 1; }
}
# Signals end the script and its tools, more than one, as by a hand that holds Ctrl-C.
ended='set -m
  "$@" & script=$!
  sleep 0.2
  for _ in 1 2 3 4 5 6 7 8; do kill -TERM -- -$script 2>/dev/null; sleep 0.001; done
  wait $script'
# faults SCRIPT OPERAND...: one of them, in turn; each with LONG=1.
turn=0
faults() {
  turn=$(((turn + 1) % 3))
  in_turn 0 && attempt 'no TMPDIR' env TMPDIR=/nonexistent "$@"
  in_turn 1 && attempt 'ended in the middle' bash -c "$ended" ended "$@"
  in_turn 2 && [ "$mounts" ] && attempt 'full TMPDIR' env TMPDIR="$scratch/full" "$@"
}
in_turn() { [ "$turn" = "$1" ] || [ -n "${LONG-}" ]; }
# makes SCRIPT OPERAND...: the same of a script that writes to $made, where the same stands before.
makes() {
  rm -rf "${made:?}"/* "$made.before"
  attempt 'no fault' "$@"
  [ "$(ls -A "$made")" ] || complain "makes nothing: $* $(cat "$scratch/out")"
  cp -R "$made" "$made.before"
  turn=0  # it is ended in the middle
  faults "$@"
  unharmed "$made" "$@"
  [ "$mounts" ] || return 0
  mount -t tmpfs -o size=64m none "$made" && cp -R "$made.before/." "$made" &&
    mount -o remount,size=$(($(df -k --output=used "$made" | tail -n 1) + 8))k "$made" || exit 2
  attempt 'full disk' "$@"
  [ $status != 0 ] || complain "full disk: exit 0: $*"
  unharmed "$made" "a full disk: $*"
  if [ -n "${LONG-}" ]; then
    mount -o remount,ro "$made" || exit 2
    attempt 'read only' "$@"
    [ $status != 0 ] || complain "read only: exit 0: $*"
  fi
  umount "$made"
}
mounts=${mounts-}
mkdir "$scratch/full"
[ ! "$mounts" ] || mount -t tmpfs -o size=8k none "$scratch/full" || exit 2

mapfile -t scripts < <(find samples cmd/install -name '*.sh' ! -name draw.sh ! -name script.sh ! -name scratch.sh)
[ ${#scripts[@]} -ge 20 ] || complain "only ${#scripts[@]} scripts"
for script in "${scripts[@]}"; do
  case $script in
    */lab.sh) makes "$script" -K 0.5 -R 0.04 -o "$made/results" runs/first.csv ;;
    */report.sh) faults "$script" figures ;;
    */figures/*.sh) faults "$script" -K 0.5 -R 0.04 -m 1.375 runs/first.csv ;;
    */roll-back.sh) faults "$script" -K 0.5 -R 0.04 runs/first.csv ;;
    */road-load.sh) makes "$script" -m 1500 --rotating 60 -o "$made/load.svg" runs/car ;;
    */exports/make.sh) makes "$script" "$made" ;;
    */live.sh) faults "$script" -K 0.5 -R 0.04 -T dumb /nonexistent ;;
    */setup.sh) PATH="$scratch/path:$PATH" faults "$script" table1 ;;
    */install.sh) DESTDIR=$made makes "$script" install ;;
    */deb.sh) if command -v dpkg-shlibdeps >/dev/null; then makes "$script"; else faults "$script"; fi ;;
    */static.sh) makes "$script" any ;;
    */html.sh) makes "$script" "$made/html" ;;
    */parts.sh) makes "$script" static "$made" ;;
    *) faults "$script" ;;
  esac
  case $script in
    samples/*)
      attempt --help "$script" --help
      [ "$(wc -l <"$scratch/out")" -ge 2 ] && ! grep -q SPDX "$scratch/out" || complain "$script --help: $(cat "$scratch/out")" ;;
  esac
  attempt 'foreign operands' "$script" x y z w
  unharmed "$tree" "$script"
done
# A folder of results that is somebody's own, and one that runs are taken from.
attempt "foreign results" samples/lab/lab.sh -K 0.5 -R 0.04 runs
grep -q 'lab.sh did not make it' "$scratch/out" || complain "lab.sh: $(cat "$scratch/out")"
attempt "runs in results" samples/lab/lab.sh -K 0.5 -R 0.04 -o results results
attempt "foreign pages" cmd/install/html.sh results
attempt "foreign exports" samples/exports/make.sh results
unharmed "$tree" foreign
attempt "no runs" samples/lab/lab.sh -K 0.5 -R 0.04 -o "$scratch/none" /nonexistent
[ ! -e "$scratch/none" ] || complain 'results of no runs'
for options in '-n abc' '-n 1' '-f x' '-t 1,5'; do
  # shellcheck disable=SC2086  # words
  attempt "law.sh $options" samples/law.sh $options thesis.tex
  grep -q '^law.sh: ' "$scratch/out" || complain "law.sh $options: $(cat "$scratch/out")"
done
for script in law.sh report.sh table1.sh; do
  attempt "$script of a file that is not there" samples/$script nothing
  [ $status != 0 ] && grep -q "^$script: nothing " "$scratch/out" || complain "$script nothing: $(cat "$scratch/out")"
done
unharmed "$tree" law.sh
exit $wrong
