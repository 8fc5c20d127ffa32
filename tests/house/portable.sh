#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a user meets does without GNU: the same comes out with every awk and every sh that is here;
# no script and no rule has what macOS and BSD lack.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
export PATH="$PWD/bin:$PATH"
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0 tried=''
complain() { echo "$*" && wrong=1; }

# Nothing that GNU make 3.81 or bash 3.2 lack, or the tools of BSD.
mapfile -t scripts < <(find cmd/install samples -name '*.sh' -type f)
forbidden='mapfile|readarray|declare -A|wait -n|\|&|\$\{[a-z_]+(\^|,,)|sed (-[a-zA-Z]+ )*(-i|--in)'
forbidden+='|install -D|tail --|head -n -|cp (-[a-z]+ )*-t|readlink -f|xargs -r|grep -[a-z]*P'
if grep -nE "^[^#]*($forbidden)" "${scripts[@]}" samples/lab/Makefile; then complain 'only GNU has that'; fi
if grep -nE '^(private|undefine|define .*=|\.ONESHELL|\.SHELLFLAGS)|: private |\$\(file |!=|::=' \
  Makefile samples/lab/Makefile; then complain 'GNU make 3.81 has no such thing'; fi

# A script is read by what its first line says, sh being any of these.
shells=()
for shell in dash 'bash --posix' 'busybox sh'; do
  command -v "${shell%% *}" >/dev/null && shells+=("$shell")
done
for script in "${scripts[@]}"; do
  first=$(grep -v '^# SPDX' "$script" | head -n 1)
  case $first in
    '#!/bin/sh')
      for shell in "${shells[@]}"; do
        $shell -n "$script" || complain "$shell does not read $script"
      done ;;
    '#!/usr/bin/env bash' | '# shellcheck shell=bash'*) bash -n "$script" || complain "$script" ;;
    *) complain "$script begins with $first" ;;
  esac
done

# What the scripts make, into the folder $1, with the sh in $shell.
everything() {
  local tool kind name
  $shell samples/table1.sh >"$1/table1" || complain "table1.sh"
  for tool in bin/*; do
    for kind in bash zsh; do
      "$tool" --help | awk -v shell=$kind -v name="${tool#bin/}" -f cmd/install/completion.awk \
        >"$1/$kind-${tool#bin/}"
    done
  done
  mkdir "$1/exports" && samples/exports/make.sh "$1/exports"
}
install_with() {  # FOLDER
  local way
  for way in install uninstall; do
    bindir=/b mandir=/m datadir=/d docdir=/doc PROGRAM_PREFIX=r- TOOLS=bin DESTDIR=$1 \
      $shell cmd/install/install.sh $way >/dev/null || complain "$way"
    (cd "$1" && find . -type f -exec cksum {} + | sort) >"$1-$way"
  done
}
drawn() {
  local name
  for name in fig1 fig1-stop fig2 fig3 fig4 fig5 energy; do
    samples/figures/$name.sh >"$1/$name.svg" || complain "$name.sh"
  done
}
shell=bash
mkdir "$scratch/first" && everything "$scratch/first" && install_with "$scratch/first-tree"
if command -v gnuplot >/dev/null; then drawn "$scratch/first"; fi

mkdir "$scratch/bin"
compare() {  # WITH WHAT
  diff -r "$scratch/first" "$scratch/other" >"$scratch/said" ||
    complain "with $1 something else comes out:" "$(head -n 20 "$scratch/said")"
  rm -rf "$scratch/other" && tried+=", $1"
}
for awk in mawk gawk 'gawk --posix' original-awk 'busybox awk'; do
  command -v "${awk%% *}" >/dev/null || continue
  [ "$($awk 'BEGIN { print 4^0.5 + log(1) }' 2>/dev/null)" = 2 ] ||
    { tried+=", not $awk, which has no exp, log and sqrt"; continue; }
  printf '#!/bin/sh\nexec %s "$@"\n' "$awk" >"$scratch/bin/awk" && chmod +x "$scratch/bin/awk"
  mkdir "$scratch/other"
  PATH=$scratch/bin:$PATH everything "$scratch/other"
  if command -v gnuplot >/dev/null; then PATH=$scratch/bin:$PATH drawn "$scratch/other"; fi
  compare "$awk"
done
for shell in "${shells[@]}"; do
  mkdir "$scratch/other" && $shell samples/table1.sh >"$scratch/other/table1"
  cmp "$scratch/first/table1" "$scratch/other/table1" || complain "with $shell Table 1 is another"
  install_with "$scratch/tree"
  for way in install uninstall; do
    diff "$scratch/first-tree-$way" "$scratch/tree-$way" || complain "$shell: $way"
  done
  rm -rf "$scratch/tree" "$scratch/other"
  tried+=", $shell"
done
echo "tried with ${tried#, }"
exit $wrong
