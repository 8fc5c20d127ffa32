#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# setup.sh GOAL...: installs the Debian packages that these goals of make need and that are missing.
# Where it cannot, it says what they are called elsewhere.
set -eu
export LC_ALL=C
unset CDPATH
cd "${0%/*}/../.."

goals=${*:-check}
packages='g++ libgsl-dev libfmt-dev libcli11-dev'
need() { packages="$packages $*"; }
is_goal() {
  name=${1#*/}
  case $1 in
    figures/report.html | figures/man/index.html | build/*) ;;
    figures/*.svg | figures/*.png) [ -e "samples/figures/${name%.*}.sh" ] ;;
    bin/*) [ -e "cmd/$name.cpp" ] ;;
    *) cut -d : -f 1 Makefile tests/targets.mk | grep -qxF -e "$1" ;;
  esac
}
for goal; do
  is_goal "$goal" || {
    echo "setup: there is no goal '$goal': nothing was installed" >&2
    exit 2
  }
done
for goal; do
  case $goal in
    all | table1 | samples | install | uninstall | clean) continue ;;
    figures | figures/* | report | paper) need gnuplot-nox mandoc; continue ;;
    html) need mandoc; continue ;;
    static) need binutils xz-utils; continue ;;
    static-arm64) need binutils xz-utils g++-aarch64-linux-gnu qemu-user; continue ;;
    deb) need dpkg-dev; continue ;;
    lint) need clang-format-14 clang-tidy-14 cppcheck shellcheck mandoc; continue ;;
    fuzz) need clang-14; continue ;;
    peers) need gnuplot-nox python3-lmfit; continue ;;
  esac
  # Whatever runs the tests.
  need catch2 libboost-dev mandoc gnuplot-nox locales busybox gawk mawk original-awk xz-utils
  case $goal in
    sanitize) need valgrind ;;
    coverage-lines) need gcovr ;;
    check-clang) need clang-14 ;;
    check-libcxx)
      n=${LIBCXX:-14}
      need clang-$n libc++-$n-dev libc++abi-$n-dev libfast-float-dev ;;
    check-arm64) need g++-aarch64-linux-gnu qemu-user ;;
  esac
done

missing=''
for package in $packages; do
  case " $missing " in *" $package "*) continue ;; esac
  dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed' ||
    missing="$missing${missing:+ }$package"
done
[ "$missing" ] || exit 0

# The names of what is missing, by the system: Debian Fedora Arch Alpine Homebrew FreeBSD; `-` where
# it needs no package. What only Debian is tried with is not in the table.
elsewhere() {
  while read -r debian fedora arch alpine brew freebsd; do
    case " $missing " in *" $debian "*) ;; *) continue ;; esac
    for name in "Fedora:dnf install:$fedora" "Arch:pacman -S:$arch" "Alpine:apk add:$alpine" \
      "macOS:brew install:$brew" "FreeBSD:pkg install:$freebsd"; do
      printf '%s\n' "$name"
    done
  done <<'END' | awk -F: '
    !($1 in how) { order[++n] = $1; how[$1] = $2 }
    $3 != "-" { names[$1] = names[$1] " " $3 }
    END { for (i = 1; i <= n; i++) if (names[order[i]] != "")
      printf "  %-8s %s%s\n", order[i], how[order[i]], names[order[i]] }'
g++ gcc-c++,make gcc,make g++,make,bash make,bash gmake,bash
libgsl-dev gsl-devel gsl gsl-dev gsl gsl
libfmt-dev fmt-devel fmt fmt-dev fmt,fast_float libfmt,fast_float
libcli11-dev cli11-devel cli11 cli11-dev cli11 cli11
gnuplot-nox gnuplot gnuplot gnuplot gnuplot gnuplot
mandoc mandoc mandoc mandoc mandoc mandoc
catch2 catch-devel catch2 catch2-3 catch2 catch2
libboost-dev boost-devel boost boost-dev boost boost-libs
END
}
give_up() {
  {
    echo "setup: $1; these packages of Debian are missing, or what your system calls them:"
    echo "  Debian   apt-get install $missing"
    elsewhere | tr , ' '
    echo "then: make $goals"
  } >&2
  exit 1
}
command -v apt-get >/dev/null || give_up 'there is no apt-get here'
as_root=''
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || give_up 'installing takes root, or sudo'
  as_root=sudo
fi
echo "installing $missing"
# shellcheck disable=SC2086  # packages are words
{
  $as_root apt-get update -q &&
    $as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -qy --no-install-recommends $missing
} || give_up 'they could not be installed'
