#!/bin/bash
# `make install` under a prefix of names and without: the tools run, the pages are found and are right, their examples run under the
# installed names; `make uninstall` removes all of it and nothing else.
set -u
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
unset MAKEFLAGS MAKELEVEL DESTDIR PREFIX PROGRAM_PREFIX
wrong=0
complain() { echo "${prefix:-no prefix}: $*" && wrong=1; }
upper() { tr '[:lower:]' '[:upper:]' <<<"$1"; }

for prefix in '' roll-; do
  stage=$scratch/stage$prefix root=$scratch/stage$prefix/opt
  put() { make "$1" DESTDIR="$stage" PREFIX=/opt PROGRAM_PREFIX="$prefix" >"$scratch/made" 2>&1 || { cat "$scratch/made" && complain "make $1 fails"; }; }
  # What others have there stays.
  others="bin/smoother share/man/man1/other share/doc/rolling/mine"
  for file in $others; do install -D /dev/null "$root/$file"; done
  put install

  for source in cmd/*.cpp; do
    plain=$(basename "$source" .cpp) tool=$prefix$(basename "$source" .cpp)
    [ "$("$root/bin/$tool" --version)" = "$tool (rolling) $(bin/smooth --version | cut -d ' ' -f 3)" ] || complain "$tool --version does not name it"
    "$root/bin/$tool" --help | grep -q "^Usage: $tool " || complain "$tool --help does not name it"
    [ "$("$root/bin/$tool" --no-such-option 2>&1 | cut -d : -f 1)" = "$tool" ] || complain "$tool does not name itself in a message"
    page=$root/share/man/man1/$tool.1
    [ "$(sed -n 2p "$page")" = ".Dt $(upper "$tool") 1" ] || complain "the title of $page is $(sed -n 2p "$page")"
    if command -v man >/dev/null; then
      found=$(man -M "$root/share/man" -w "$tool") && [ "$found" -ef "$page" ] || complain "man finds ${found:-nothing} for $tool"
      [ -z "$prefix" ] || ! man -M "$root/share/man" -w "$plain" >/dev/null 2>&1 || complain "man finds a page $plain"
    fi
    # A page refers to what is there: with the prefix too.
    while read -r name section; do
      case $name in awk | sed | sort | gnuplot) continue ;; esac
      [ -r "$root/share/man/man$section/$name.$section" ] || complain "$page refers to $name($section), which is not installed"
    done < <(grep -ohE 'Xr [^ ]+ [1-8]' "$page" "$root"/share/man/man[57]/* | cut -d ' ' -f 2,3 | sort -u)
  done
  [ "$(find "$root/bin" -name "${prefix}*" ! -name smoother -type f -perm 755 | wc -l)" = "$(find cmd -name '*.cpp' | wc -l)" ] || complain "other programs than those of cmd/: $(ls "$root/bin")"
  [ -z "$(find "$root/share" -type f ! -name mine ! -name other ! -perm 644)" ] || complain "modes: $(find "$root/share" -type f ! -perm 644)"
  # The words of the history stay: fitpower reads them.
  "$root/bin/${prefix}smooth" -q samples/CR.csv | grep -q '^## smooth v mean width 11$' || complain "${prefix}smooth does not write ## smooth"
  if command -v mandoc >/dev/null; then
    mandoc -Tlint -Wwarning "$root"/share/man/man[157]/*.[157] || complain "the pages are not right"
    tests/house/man-examples.sh "$root" >"$scratch/examples" 2>&1 || { cat "$scratch/examples" && complain "the examples of the installed pages"; }
  fi

  put uninstall
  left=$(cd "$root" && find . -type f | cut -c 3- | sort | xargs)
  [ "$left" = "$(printf '%s\n' $others | sort | xargs)" ] || complain "after uninstall there is $left"
  rm "$root/share/doc/rolling/mine"
  put uninstall
  [ ! -e "$root/share/doc/rolling" ] || complain "uninstall leaves share/doc/rolling"
done
grep -q "version $(bin/smooth --version | cut -d " " -f 3)\." README.md || { echo "README.md names another version" && wrong=1; }
exit $wrong
