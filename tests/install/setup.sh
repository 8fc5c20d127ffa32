#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make setup GOAL...` installs what these goals need and is missing, nothing else, before anything
# is built. Without root it uses sudo; without both, without apt-get and where sudo refuses, it names
# what is missing, here and on other systems. A goal that there is not is told first.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# Stand-ins: a user who is not root, on a machine where no package is installed.
stand_in() { printf '#!/bin/sh\n%s\n' "$2" >"$scratch/$1" && chmod +x "$scratch/$1"; }
stand_in dpkg-query 'exit 1'
stand_in id 'echo 1000'
stand_in sudo 'echo "sudo $*"'
stand_in apt-get 'echo "without sudo: apt-get $*"; exit 1'

needs() {  # GOALS PACKAGES: those besides compiler and libraries
  local said
  # shellcheck disable=SC2086  # goals are words
  said=$(PATH="$scratch:$PATH" cmd/install/setup.sh $1 2>&1) || complain "setup $1: $said"
  said=$(grep -o 'no-install-recommends.*' <<<"$said" | cut -d ' ' -f 2- | tr ' ' '\n' |
    grep -vxE 'g\+\+|lib(gsl|fmt|cli11)-dev' | sort -u | xargs)
  [ "$said" = "$2" ] || complain "setup $1 installs '$said' instead of '$2'"
}
needs table1 ''
needs 'all install' ''
needs figures 'gnuplot-nox mandoc'
needs figures/fig4.svg 'gnuplot-nox mandoc'
needs 'report table1' 'gnuplot-nox mandoc'
needs html mandoc
needs 'table1 html' mandoc
needs 'html deb' 'dpkg-dev mandoc'
needs deb dpkg-dev
needs static 'binutils xz-utils'
needs static-arm64 'binutils g++-aarch64-linux-gnu qemu-user xz-utils'
needs peers 'gnuplot-nox python3-lmfit'
needs lint 'clang-format-14 clang-tidy-14 cppcheck mandoc shellcheck'
needs check 'busybox catch2 gawk gnuplot-nox libboost-dev locales mandoc mawk original-awk xz-utils'
needs check-arm64 'busybox catch2 g++-aarch64-linux-gnu gawk gnuplot-nox libboost-dev locales mandoc mawk original-awk qemu-user xz-utils'
needs check-clang 'busybox catch2 clang-14 gawk gnuplot-nox libboost-dev locales mandoc mawk original-awk xz-utils'
needs check-libcxx 'busybox catch2 clang-14 gawk gnuplot-nox libboost-dev libc++-14-dev libc++abi-14-dev libfast-float-dev locales mandoc mawk original-awk xz-utils'
LIBCXX=19 needs check-libcxx 'busybox catch2 clang-19 gawk gnuplot-nox libboost-dev libc++-19-dev libc++abi-19-dev libfast-float-dev locales mandoc mawk original-awk xz-utils'
needs sanitize 'busybox catch2 gawk gnuplot-nox libboost-dev locales mandoc mawk original-awk valgrind xz-utils'

stand_in dpkg-query 'echo install ok installed'
said=$(PATH="$scratch:$PATH" cmd/install/setup.sh check 2>&1) && [ -z "$said" ] ||
  complain "where nothing is missing: $said"
said=$(make -n setup table1 2>/dev/null | head -n 1)
[ "$said" = 'cmd/install/setup.sh table1' ] || complain "make setup table1 begins with $said"

# Other flags compile again, the same do not.
mkdir -p "$scratch/flags/lib/one" "$scratch/flags/tests"
cp Makefile "$scratch/flags" && cp tests/targets.mk "$scratch/flags/tests"
echo 'int one();' >"$scratch/flags/lib/one/one.cpp"
compiled() { (cd "$scratch/flags" && make CXX=g++ build/lib/one.o "$@" 2>&1) | grep -c ' -c '; }
said="$(compiled) $(compiled) $(compiled CXXFLAGS=-O1) $(compiled CXXFLAGS=-O1) $(compiled)"
[ "$said" = '1 0 1 0 1' ] || complain "compilations by flags: $said"

# A path with nothing but what the script calls.
mkdir "$scratch/bare" &&
  ln -s "$(command -v grep)" "$(command -v bash)" "$(command -v awk)" "$(command -v tr)" "$(command -v cut)" "$scratch/bare"
cp "$scratch/id" "$scratch/bare"
without() {  # WHAT PATH: the script gives up and says how to go on
  said=$(PATH=$2 "$scratch/bare/bash" cmd/install/setup.sh table1 2>&1) &&
    complain "setup without $1: exit 0"
  for line in 'Debian   apt-get install g++ libgsl-dev libfmt-dev libcli11-dev' \
    'Fedora   dnf install gcc-c++ make gsl-devel fmt-devel cli11-devel' \
    'Arch     pacman -S gcc make gsl fmt cli11' \
    'Alpine   apk add g++ make bash gsl-dev fmt-dev cli11-dev' \
    'macOS    brew install make bash gsl fmt fast_float cli11' \
    'FreeBSD  pkg install gmake bash gsl libfmt fast_float cli11'; do
    grep -qxF "  $line" <<<"$said" || complain "setup without $1 does not say '$line': $said"
  done
  [ "$(tail -n 1 <<<"$said")" = 'then: make table1' ] || complain "setup without $1 ends with $said"
}
cp "$scratch/apt-get" "$scratch/bare"
without sudo "$scratch/bare"
rm "$scratch/bare/apt-get"
without apt-get "$scratch/bare"
stand_in dpkg-query 'exit 1'
stand_in sudo 'echo "user is not in the sudoers file" >&2; exit 1'
without leave "$scratch:$PATH"

# A word that is no goal: nothing is asked of anybody.
stand_in sudo "touch '$scratch/asked'"
for goals in tabel1 'table1 chekc' 'table. figures' figures/fgi4.svg figures/x/fig4.svg bin/smoth bin/x/smooth results/x; do
  # shellcheck disable=SC2086
  said=$(PATH="$scratch:$PATH" make setup $goals 2>&1) && complain "make setup $goals: exit 0"
  grep -q '^setup: there is no goal ' <<<"$said" || complain "make setup $goals says $said"
done
[ ! -e "$scratch/asked" ] || complain 'a misspelt goal installs something'

# Figures without gnuplot: one line that says how to have it, and nothing half made.
mkdir "$scratch/plain" && tar -cf - Makefile samples man cmd tests/targets.mk | tar -xf - -C "$scratch/plain"
mkdir "$scratch/plain/bin"
for tool in bin/*; do ln -s "$PWD/$tool" "$scratch/plain/bin"; done
ln -sf "$(command -v make)" "$(command -v nproc)" "$(command -v grep)" "$(command -v sort)" \
  "$(command -v mkdir)" "$(command -v env)" "$(command -v sh)" "$scratch/bare"
said=$(cd "$scratch/plain" &&
  PATH="$scratch/bare" make -o bin/smooth -o bin/differentiate -o bin/shift-from-accel \
    -o bin/fitpower -o bin/simulate -o bin/energy-ledger figures/fig4.svg 2>&1) && complain "a figure without gnuplot: exit 0"
grep -q 'make setup figures installs it' <<<"$said" || complain "without gnuplot: $said"
[ ! -e "$scratch/plain/figures" ] || complain "without gnuplot: $(ls "$scratch/plain/figures")"
exit $wrong
