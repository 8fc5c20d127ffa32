#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a user meets does without GNU: the same comes out with every awk and every sh that is here;
# no script and no rule has what macOS and BSD lack. The scripts run with LONG=1: make check-long.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
export PATH="$PWD/bin:$PATH"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0 tried=''
complain() { echo "$*" && wrong=1; }

# Nothing that GNU make 3.81 or bash 3.2 lack, or the tools of BSD: in sed, \n in what comes in. The
# packages of Linux are made with its tools.
mapfile -t scripts < <(find cmd/install samples -name '*.sh' -type f)
forbidden='mapfile|readarray|declare -A|wait -n|\|&|\$\{[a-z_]+(\^|,,)|sed (-[a-zA-Z]+ )*(-i|--in)'
forbidden+='|install -D|tail [^|]*--[a-z]|head -n -|cp (-[a-z]+ )*-t|readlink -f|xargs -r|grep -[a-z]*P'
of_gnu='-printf|sort -[a-z]*[Vz]|\b(date|touch) .*-d|stat -c|\b(nproc|realpath|tac|shuf|timeout) '
of_gnu+='|\bs([/|])[^/|]*\4[^/|]*\\n'
if grep -nE "^[^#]*($forbidden)" "${scripts[@]}" ||
  grep -nE "^[^#]*($of_gnu)" "${scripts[@]}" | grep -vE '^cmd/install/(deb|static|parts|date)\.sh:'
then complain 'only GNU has that'; fi
if grep -nE '^(private|undefine|define .*=|\.ONESHELL|\.SHELLFLAGS)|: private |\$\(file |!=|::=' \
  Makefile; then complain 'GNU make 3.81 has no such thing'; fi

# An algorithm of ranges that libc++ 14 lacks is in the header that stands in for it.
for name in $(grep -ohE '\branges::[a-z_]+' -r lib cmd tests/unit tests/pipeline | sort -u); do
  grep -qE "\b(auto|bool|using|Permuted) ${name#*::}\b|\(${name#*::}\)" tests/libcxx/ranges.h ||
    complain "tests/libcxx/ranges.h lacks $name"
done

[ -n "${LONG-}" ] || exit $wrong

# Every script, in a copy whose scripts for sh run in the shell $1, a path: what they make goes into
# the folder $2. It takes the awk that is on the PATH.
everything() {
  local tool kind name file
  rm -rf "$scratch/copy" && mkdir -p "$scratch/copy" "$2/exports"
  tar -cf - Makefile README.md cmd man samples tests/targets.mk | tar -xf - -C "$scratch/copy" || exit 2
  ln -s "$PWD/bin" "$scratch/copy/bin"
  for file in "${scripts[@]}"; do
    case $(grep -v '^# SPDX' "$file" | head -n 1) in
      '#!/bin/sh') { echo "#!$1" && tail -n +2 "$file"; } >"$scratch/copy/$file" ;;
      '# shellcheck shell=sh') ;;
      '#!/usr/bin/env bash' | '# shellcheck shell=bash'*) bash -n "$file" || complain "$file" ;;
      *) complain "$file does not say which shell it is for" ;;
    esac
  done
  pushd "$scratch/copy" >/dev/null || exit 2
  samples/table1.sh >"$2/table1" || complain table1.sh
  for tool in bin/*; do
    for kind in bash zsh fish; do
      "$tool" --help | awk -v shell=$kind -v name="${tool#bin/}" -f cmd/install/completion.awk \
        >"$2/$kind-${tool#bin/}"
    done
  done
  samples/exports/make.sh "$2/exports" || complain exports/make.sh
  samples/shape-factor.sh >"$2/shape-factor" || complain shape-factor.sh
  samples/roll-back.sh -K 0.5 -R 0.04 samples/CR.csv >"$2/roll-back" 2>/dev/null || complain roll-back.sh
  samples/lab/lab.sh -K 0.5 -R 0.04 -o "$2/results" samples/C?.csv >"$2/lab" 2>"$2/lab-said" ||
    complain lab.sh
  samples/law.sh "$2/lab" >"$2/law" || complain law.sh
  if command -v mandoc >/dev/null; then cmd/install/html.sh "$2/man" || complain html.sh; fi
  if command -v gnuplot >/dev/null; then
    for name in fig1 fig1-stop fig2 fig3 fig4 fig5 energy turn residuals; do
      samples/figures/$name.sh >"$2/$name.svg" || complain "$name.sh"
    done
    samples/paper.sh >"$2/paper" || complain paper.sh
    samples/report.sh "$2" >"$scratch/report" || complain report.sh
    # Without the times that the solvers took.
    grep -v '^<tr><td>[a-z0-9]*</td>' "$scratch/report" >"$2/report"
  fi
  for kind in install uninstall; do
    bindir=/b mandir=/m datadir=/d docdir=/doc PROGRAM_PREFIX=r- TOOLS=bin DESTDIR=$2/tree \
      cmd/install/install.sh $kind >/dev/null || complain "install.sh $kind"
    # The list has the sums of the scripts, whose first lines differ here.
    (cd "$2/tree" && find . -type f ! -path './doc/*' -exec cksum {} + | sort) >"$2/$kind"
    (cd "$2/tree" && find . | sort) >>"$2/$kind"
  done
  rm -r "$2/tree"
  popd >/dev/null || exit 2
}
compare() {  # WITH WHAT
  diff -r "$scratch/first" "$scratch/other" >"$scratch/said" ||
    complain "with $1 something else comes out:" "$(head -n 20 "$scratch/said")"
  rm -rf "$scratch/other" && tried+=", $1"
}
everything /bin/sh "$scratch/first"
[ "$(find "$scratch/first" -type f | wc -l)" -ge 30 ] || complain "only $(ls -R "$scratch/first")"

# The examples of the pages and of the READMEs too, with each awk.
mkdir "$scratch/bin"
for awk in mawk 'gawk --posix' original-awk 'busybox awk'; do
  command -v "${awk%% *}" >/dev/null || continue
  [ "$($awk 'BEGIN { print 4^0.5 + log(1) }' 2>/dev/null)" = 2 ] ||
    { tried+=", not $awk, which has no exp, log and sqrt"; continue; }
  printf '#!/bin/sh\nexec %s "$@"\n' "$awk" >"$scratch/bin/awk" && chmod +x "$scratch/bin/awk"
  PATH=$scratch/bin:$PATH everything /bin/sh "$scratch/other"
  compare "$awk"
  for name in man-examples readme; do
    PATH=$scratch/bin:$PATH tests/pages/$name.sh >"$scratch/said" 2>&1 || [ $? = 77 ] ||
      complain "with $awk: $(head -n 20 "$scratch/said")"
  done
done
for shell in dash 'bash --posix' 'busybox sh'; do
  command -v "${shell%% *}" >/dev/null || continue
  everything "$(command -v "${shell%% *}")${shell#"${shell%% *}"}" "$scratch/other"
  compare "$shell"
done
echo "tried with ${tried#, }"
exit $wrong
