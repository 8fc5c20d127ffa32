#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make static` makes an archive that needs nothing of the system: in an empty root with busybox
# alone its tools give Table 1 and the rest of the samples byte for byte.
set -u
export LC_ALL=C
unset CDPATH MAKEFLAGS MAKELEVEL
cd "$(dirname "$0")/../.." || exit 2
[ -x build/static/bin/smooth ] ||
  { echo "skipped: no static library of GSL here (Debian's libgsl-dev has it)" && exit 77; }
command -v busybox >/dev/null || { echo "skipped: no busybox; make setup check installs it" && exit 77; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
export SOURCE_DATE_EPOCH=1600000000 XZ_OPT=-0
make static >"$scratch/made" 2>&1 || { cat "$scratch/made" && exit 1; }
archive=build/rolling-$(bin/smooth --version | cut -d ' ' -f 3)-linux-$(uname -m).tar.xz

root=$scratch/root
mkdir -p "$root/bin" "$root/tmp" "$root/dev"
tar -xf "$archive" -C "$root" --strip-components=1
for tool in "$root"/bin/*; do
  if grep -qF "$PWD" "$tool"; then complain "$tool names the folder in which it was built"; fi
  readelf -ld "$tool" | grep -E 'INTERP|NEEDED' && complain "$tool is not static"
done
for file in README.md LICENSE NOTICES CITATION.cff samples/table1.sh share/man/man1/smooth.1 share/man/man7/rolling-fits.7 \
  share/bash-completion/completions/smooth share/zsh/site-functions/_smooth \
  share/fish/vendor_completions.d/smooth.fish; do
  [ -s "$root/$file" ] || complain "$file is missing"
done
[ "$(find "$root" -type f ! -path "$root/bin/*" -newermt '2020-09-13 12:27' | wc -l)" = 0 ] ||
  complain "files of another date"

# The list of parts has the versions of Debian's packages and of --version; each has its notice.
parts=$(sed -nE 's/.*"type": "library", "name": "([^"]*)", "version": "([^"]*)".*/\1 \2/p' "$root/parts.cdx.json")
while read -r name package; do
  version=$(dpkg-query -W -f '${Version}' "$package") || continue
  listed=$(sed -n "s/^$name //p" <<<"$parts")
  [[ -n $listed && ( $version == "$listed" || $version == "$listed"[!0-9.]* ) ]] ||
    complain "the list has $name $listed, and it is $version"
  grep -qF "==== $name $listed," "$root/NOTICES" || complain "no notice of $name $listed"
  # Where its source is: by the name and the version of the source, in brackets where they differ.
  from=$(dpkg -s "$package" | sed -nE 's/^Source: //p')
  [[ $from == *'('* ]] && version=${from#*(} && version=${version%)}
  source=https://snapshot.debian.org/package/${from%% *}/$version/
  [ -n "$from" ] || source=https://snapshot.debian.org/package/$package/$version/
  grep -qF "\"$source\"" "$root/parts.cdx.json" && grep -qxF "$source" "$root/NOTICES" ||
    complain "no address $source"
done < <(printf '%s\n' 'CLI11 libcli11-dev' 'fmt libfmt-dev' 'GSL libgsl-dev' 'glibc libc6-dev' \
  "libstdc++ libstdc++-$(g++ -dumpversion)-dev")
for words in "rolling $(bin/smooth --version | cut -d ' ' -f 3)," 'the authors of rolling' 'Henry Schreiner' 'Victor Zverovich' 'GNU LESSER GENERAL PUBLIC' 'RUNTIME LIBRARY EXCEPTION'; do
  grep -q "$words" "$root/NOTICES" || complain "the notices lack $words"
done
grep -qF '"expression": "GPL-3.0-or-later WITH GCC-exception-3.1"' "$root/parts.cdx.json" ||
  complain "the licence of libstdc++: $(grep expression "$root/parts.cdx.json")"
! command -v python3 >/dev/null || python3 -m json.tool "$root/parts.cdx.json" >/dev/null ||
  complain "parts.cdx.json is no JSON"

# busybox, with the libraries that it may need: the tools need none.
# That of Debian has an awk without powers and roots: where it is so, the system's awk comes along.
programs=(busybox)
[ "$(busybox awk 'BEGIN { print 4^0.5 }' 2>/dev/null)" = 2 ] || programs+=(awk)
for program in "${programs[@]}"; do
  cp -L "$(command -v "$program")" "$root/bin/$program"
  ldd "$root/bin/$program" 2>/dev/null | grep -oE '/[^ ]+' | while IFS= read -r library; do
    mkdir -p "$root${library%/*}" && cp "$library" "$root$library"
  done
done
in_root() { unshare -r chroot "$root" /bin/busybox env -i PATH=/bin TMPDIR=/tmp /bin/sh -c "$1"; }
ln -s busybox "$root/bin/sh"
in_root '/bin/busybox --install -s /bin 2>/dev/null; ls >/dev/null' 2>"$scratch/said" || {
  echo "skipped: no root of one's own can be made here: $(cat "$scratch/said")"
  exit $((wrong ? 1 : 77))
}
: >"$root/dev/null"
in_root 'cd /samples && ./table1.sh' >"$scratch/there" 2>&1 || complain "table1.sh fails there"
samples/table1.sh >"$scratch/here"
diff "$scratch/here" "$scratch/there" || complain "Table 1 is another there"
products='for run in CF CR SF SR; do
  simulate --scene $run.toml --sensor pasco --seed 7
  simulate --scene $run.toml --exact --slope 0.001
  smooth --coast -w 11 $run.csv | differentiate | shift-from-accel -K 0.5 -R 0.04
  smooth -M savgol -w 11 $run.csv | differentiate -M savgol -w 7
  smooth --coast -q -c x -w 1 $run.csv | fitpower -q --route position -K 0.5 -R 0.04
  simulate --scene $run.toml | energy-ledger --scene $run.toml
done'
in_root "cd /samples && $products" >"$scratch/there" 2>&1
(cd samples && PATH="$PWD/../bin:$PATH" sh -c "$products") >"$scratch/here" 2>&1
[ "$(wc -l <"$scratch/here")" -gt 5000 ] || complain "only $(wc -l <"$scratch/here") lines of samples"
cmp "$scratch/here" "$scratch/there" || complain "the samples give something else there"
exit $wrong
