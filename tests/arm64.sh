#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# arm64.sh FOLDER [PROGRAM...]: builds for arm64 in FOLDER, a copy of the sources, runs the tests there
# through qemu's user mode, and compares with bin/ what the samples give, byte for byte; or builds
# these static programs, and compares Table 1. It takes g++-aarch64-linux-gnu and qemu-user. The
# libraries are Debian's for arm64, unpacked into FOLDER/sysroot: nothing is installed.
set -euo pipefail
export LC_ALL=C
unset CDPATH MAKEFLAGS
here=$PWD
cd "$1"
shift
goals=(all build/unit)
[ $# = 0 ] || goals=("$@")
root=$PWD
sysroot=$root/sysroot
library=$sysroot/usr/lib/aarch64-linux-gnu
for program in aarch64-linux-gnu-g++ qemu-aarch64; do
  command -v $program >/dev/null ||
    { echo "there is no $program here; make setup check-arm64 installs it" >&2; exit 1; }
done

# A list of arm64's packages of its own, beside the system's. What is headers alone is the same on
# every machine.
if [ ! -e "$library/libfmt.so" ] || [ ! -e "$library/libgsl.so" ]; then
  echo 'fetching the libraries of arm64'
  mkdir -p "$root/apt/lists/partial" "$root/apt/cache/archives/partial" "$sysroot/usr/include"
  cat >"$root/apt.conf" <<END
Dir::State "$root/apt";
Dir::State::status "/dev/null";
Dir::Cache "$root/apt/cache";
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "";
END
  export APT_CONFIG=$root/apt.conf
  apt-get update -qq
  packages=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts \
    --no-breaks --no-replaces --no-enhances libgsl-dev libfmt-dev catch2 | grep -E '^(lib(gsl|fmt)|catch2)')
  (cd "$root/apt" && rm -f ./*.deb && xargs apt-get download -qq <<<"$packages")
  for package in "$root"/apt/*.deb; do dpkg-deb -x "$package" "$sysroot"; done
  unset APT_CONFIG
fi
ln -sfn /usr/include/CLI /usr/include/boost "$sysroot/usr/include"

# -Wno-psabi: g++ notes there, for each pair of doubles passed, that its version 9 did otherwise.
make -s -j"$(nproc)" "${goals[@]}" AR=aarch64-linux-gnu-ar \
  CXX="${ARM64_CXX:-aarch64-linux-gnu-g++} -isystem sysroot/usr/include -Wno-psabi" \
  LDFLAGS='-Lsysroot/usr/lib/aarch64-linux-gnu -Lsysroot/usr/lib -Wl,-rpath-link,sysroot/usr/lib/aarch64-linux-gnu'

if [ $# -gt 0 ]; then
  mkdir -p emulated/bin && cp -R samples emulated
  for program; do
    printf '#!/bin/sh\nexec qemu-aarch64 %q "$@"\n' "$root/$program" >"emulated/bin/${program##*/}"
    chmod +x "emulated/bin/${program##*/}"
  done
  emulated/samples/table1.sh >build/there
  "$here/samples/table1.sh" >build/here
  cmp build/there build/here
  echo "$(wc -l <build/here) lines of Table 1 compared"
  exit
fi

# In front of each program that make has linked, a script of its name that calls it through qemu.
for program in bin/* build/unit; do
  [ "$(head -c 4 "$program" | tail -c 3)" = ELF ] || continue
  mkdir -p programs
  mv "$program" "programs/${program##*/}"
  printf '#!/bin/sh\nexec qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=%q %q "$@"\n' \
    "$library" "$root/programs/${program##*/}" >"$program"
  chmod +x "$program"
done

# Without faults/, which preloads a library and limits memory (here that of qemu), and without what
# looks at the sources or the machine. qemu takes some ten times as long.
status=0
SLOWER=20 tests/run.sh build/unit tests/tools tests/pipeline/{table1,samples-reproduce,equations}.sh \
  tests/pipeline/{energy-check,pasco,vernier,shape-factor}.sh tests/pages/man-examples.sh || status=1

# What the samples give here and on the machine that makes them: the same bytes.
products() {  # TOOLS
  local PATH=$1:$PATH name body=(-K 0.5 -R 0.04)
  for name in CF CR SF SR; do
    simulate --scene "samples/$name.toml"
    simulate --scene "samples/$name.toml" --exact --slope 0.001
    simulate --scene "samples/$name.toml" --sensor pasco --seed 7
    smooth --coast -w 11 "samples/$name.csv" | differentiate | shift-from-accel "${body[@]}"
    smooth -M savgol -w 11 "samples/$name.csv" | differentiate -M savgol -w 7
    smooth --coast -q -c x -w 1 "samples/$name.csv" | fitpower -q --route position "${body[@]}"
    simulate --scene "samples/$name.toml" | energy-ledger --scene "samples/$name.toml"
  done
  samples/table1.sh
}
products "$root/bin" >build/there
products "$here/bin" >build/here
cmp build/there build/here || status=1
echo "$(wc -l <build/here) lines of the samples compared"
exit $status
