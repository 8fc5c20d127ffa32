#!/bin/bash
# setup.sh GOAL...: installs the Debian packages that these goals of make need and that are missing.
set -euo pipefail
export LC_ALL=C
unset CDPATH

packages=(g++ libgsl-dev libfmt-dev libcli11-dev)
for goal; do
  case $goal in
    all | table1 | samples | install | uninstall | clean) ;;
    figures | figures/* | report) packages+=(gnuplot-nox mandoc) ;;
    html) packages+=(mandoc) ;;
    deb) packages+=(dpkg-dev) ;;
    lint) packages+=(clang-format-14 clang-tidy-14 cppcheck shellcheck mandoc) ;;
    fuzz) packages+=(clang-14) ;;
    *) packages+=(catch2 libboost-dev mandoc gnuplot-nox locales) ;;&  # whatever runs the tests
    sanitize) packages+=(valgrind) ;;
    coverage-lines) packages+=(gcovr) ;;
    check-clang) packages+=(clang-14) ;;
    check-arm64) packages+=(g++-aarch64-linux-gnu qemu-user) ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed' ||
    missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

give_up() {
  echo "setup: $1; these packages of Debian are missing, or what your system calls them:" >&2
  echo "  ${missing[*]}" >&2
  exit 1
}
command -v apt-get >/dev/null || give_up 'there is no apt-get here'
as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || give_up 'installing takes root, or sudo'
  as_root=(sudo)
fi
echo "installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qy --no-install-recommends "${missing[@]}"
