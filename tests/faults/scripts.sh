#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No script harms what it did not make. Each script of samples and cmd/install runs in a tree with
# files of somebody's own: without a folder for scratch files, with a TMPDIR that is a file, beside a
# foreign folder `results`, with operands that mean nothing, and ended in the middle. Afterwards the
# tree is byte for byte what it was, and no scratch is left.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

tree="$scratch/a thesis"
mkdir -p "$tree/results" "$tree/runs" "$tree/figures" "$scratch/tmp" "$scratch/home"
cp -R samples cmd man Makefile README.md LICENSE "$tree"
ln -s "$PWD/bin" "$tree/bin"
echo 'years of work' | tee "$tree/thesis.tex" "$tree/results/table.txt" "$tree/results/mine" >/dev/null
cp samples/CR.csv "$tree/runs/first.csv"
cp samples/CF.csv "$tree/results/second.csv"
: >"$scratch/file"
state() { (cd "$tree" && find . -type f -exec cksum {} + | sort && find . | sort); }
before=$(state)

# attempt NAME COMMAND...: in the tree, within 20 seconds.
attempt() {
  local name=$1 status
  shift
  (cd "$tree" && timeout 20 "$@") </dev/null >"$scratch/out" 2>&1
  status=$?
  [ $status != 124 ] || complain "$name does not end: $*"
  [ "$(state)" = "$before" ] || { complain "$name harms: $*" && diff <(echo "$before") <(state) | head -n 5; exit 1; }
  [ -z "$(ls -A "$scratch/tmp")" ] || { complain "$name leaves scratch: $* $(ls "$scratch/tmp")" && rm -rf "$scratch/tmp"/*; }
}
export TMPDIR="$scratch/tmp"
mapfile -t scripts < <(find samples cmd/install -name '*.sh' ! -name draw.sh ! -name script.sh)
[ ${#scripts[@]} -ge 20 ] || complain "only ${#scripts[@]} scripts"
for script in "${scripts[@]}"; do
  case $script in
    */lab.sh) operands=(-K 0.5 -R 0.04 -o "$scratch/made" runs) ;;
    */report.sh) operands=(figures) ;;
    */figures/*.sh) operands=(-K 0.5 -R 0.04 -m 1.375 runs/first.csv) ;;
    */roll-back.sh) operands=(-K 0.5 -R 0.04 runs/first.csv) ;;
    */exports/make.sh) operands=("$scratch/home") ;;
    */live.sh) operands=(-K 0.5 -R 0.04 -T dumb /nonexistent) ;;
    cmd/install/install.sh)
      operands=(install)
      export DESTDIR=$scratch/home bindir=/b mandir=/m datadir=/d docdir=/o TOOLS=bin ;;
    # These work in build/, which stands beside no work of anybody.
    cmd/install/setup.sh | cmd/install/deb.sh | cmd/install/static.sh) continue ;;
    cmd/install/html.sh) operands=("$scratch/home/html") ;;
    *) operands=() ;;
  esac
  attempt "no TMPDIR" env TMPDIR=/nonexistent "$script" ${operands[@]+"${operands[@]}"}
  attempt "TMPDIR is a file" env TMPDIR="$scratch/file" "$script" ${operands[@]+"${operands[@]}"}
  case $script in
    samples/*)
      attempt "foreign operands" "$script" x y z w
      attempt --help "$script" --help
      [ "$(wc -l <"$scratch/out")" -ge 2 ] || complain "$script --help: $(cat "$scratch/out")"
      # shellcheck disable=SC2016  # for the shell within
      attempt "ended in the middle" bash -c '"$@" & sleep 0.1; kill $!; wait' - "$script" \
        ${operands[@]+"${operands[@]}"} ;;
  esac
done
# A folder of results that is somebody's own, and one that runs are taken from.
attempt "foreign results" samples/lab/lab.sh -K 0.5 -R 0.04 runs
grep -q 'lab.sh did not make it' "$scratch/out" || complain "lab.sh: $(cat "$scratch/out")"
attempt "runs in results" samples/lab/lab.sh -K 0.5 -R 0.04 -o results results
attempt "no runs" samples/lab/lab.sh -K 0.5 -R 0.04 -o "$scratch/none" /nonexistent
[ ! -e "$scratch/none" ] || complain 'results of no runs'
for options in '-n abc' '-n 1' '-f x' '-t 1,5'; do
  # shellcheck disable=SC2086  # words
  attempt "law.sh $options" samples/law.sh $options thesis.tex
  grep -q '^law.sh: ' "$scratch/out" || complain "law.sh $options: $(cat "$scratch/out")"
done
# A full disk, where a small one can be mounted: the results of before stay whole.
if mkdir "$scratch/disk" && mount -t tmpfs -o size=64k none "$scratch/disk" 2>/dev/null; then
  attempt "full disk" samples/lab/lab.sh -K 0.5 -R 0.04 -o "$scratch/disk/results" runs
  attempt "full TMPDIR" env TMPDIR="$scratch/disk" samples/table1.sh
  [ "$(ls -A "$scratch/disk")" = '' ] || [ -e "$scratch/disk/results/made-by-lab" ] ||
    complain "on a full disk: $(ls -A "$scratch/disk")"
  umount "$scratch/disk"
fi
exit $wrong
