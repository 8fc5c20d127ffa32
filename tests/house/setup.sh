#!/bin/bash
# `make setup GOAL...` installs what these goals need and is missing, nothing else, before anything
# is built. Without root it uses sudo; without both, and without apt-get, it names what is missing.
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
needs deb dpkg-dev
needs lint 'clang-format-14 clang-tidy-14 cppcheck mandoc shellcheck'
needs check 'catch2 gnuplot-nox libboost-dev locales mandoc'
needs check-arm64 'catch2 g++-aarch64-linux-gnu gnuplot-nox libboost-dev locales mandoc qemu-user'
needs check-clang 'catch2 clang-14 gnuplot-nox libboost-dev locales mandoc'
needs sanitize 'catch2 gnuplot-nox libboost-dev locales mandoc valgrind'

stand_in dpkg-query 'echo install ok installed'
said=$(PATH="$scratch:$PATH" cmd/install/setup.sh check 2>&1) && [ -z "$said" ] ||
  complain "where nothing is missing: $said"
said=$(make -n setup table1 2>/dev/null | head -n 1)
[ "$said" = 'cmd/install/setup.sh table1' ] || complain "make setup table1 begins with $said"

# A path with nothing but what the script calls.
mkdir "$scratch/bare" && ln -s "$(command -v grep)" "$(command -v bash)" "$scratch/bare"
cp "$scratch/id" "$scratch/bare"
for missing in sudo apt-get; do
  [ $missing = apt-get ] || cp "$scratch/apt-get" "$scratch/bare"
  [ $missing = sudo ] || rm "$scratch/bare/apt-get"
  said=$(PATH="$scratch/bare" "$scratch/bare/bash" cmd/install/setup.sh table1 2>&1) &&
    complain "setup without $missing: exit 0"
  grep -q '^  g++ libgsl-dev libfmt-dev libcli11-dev$' <<<"$said" ||
    complain "setup without $missing says '$said'"
done

# Figures without gnuplot: one line that says how to have it, and nothing half made.
mkdir "$scratch/plain" && tar -cf - Makefile samples man cmd | tar -xf - -C "$scratch/plain"
mkdir "$scratch/plain/bin"
for tool in bin/*; do ln -s "$PWD/$tool" "$scratch/plain/bin"; done
ln -s "$(command -v make)" "$(command -v nproc)" "$(command -v grep)" "$(command -v sort)" \
  "$(command -v mkdir)" "$(command -v env)" "$scratch/bare"
said=$(cd "$scratch/plain" &&
  PATH="$scratch/bare" make -o bin/smooth -o bin/differentiate -o bin/shift-from-accel \
    -o bin/fitpower figures/fig4.svg 2>&1) && complain "a figure without gnuplot: exit 0"
grep -q 'make setup figures installs it' <<<"$said" || complain "without gnuplot: $said"
[ ! -e "$scratch/plain/figures" ] || complain "without gnuplot: $(ls "$scratch/plain/figures")"
exit $wrong
