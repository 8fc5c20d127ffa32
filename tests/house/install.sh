#!/bin/bash
# `make install` with plain and with prefixed names: the tools run, the pages are found and are
# right, their examples run under the installed names; `make uninstall` removes all of it and
# nothing else. Both whatever the environment is and whatever signs the folder has in its name.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
PATH=${PATH#"$PWD/bin:"}  # where there are only tools with a prefix
unset MAKEFLAGS MAKELEVEL DESTDIR PREFIX PROGRAM_PREFIX
wrong=0
complain() { echo "${prefix:-no prefix}: $*" && wrong=1; }
upper() { tr '[:lower:]' '[:upper:]' <<<"$1"; }

# The second name has what a shell and make could take for code: it would make a file `hit`.
hostile="a b'c\"d&e;touch hit#\`touch hit\`(f)\\g*"
for prefix in '' roll-; do
  stage=$scratch/stage$prefix
  opt=/opt
  [ -z "$prefix" ] || opt=/$hostile
  root=$stage$opt
  put() {
    env CDPATH=.:/ LANG=de_DE.UTF-8 LC_ALL=de_DE.UTF-8 LOCPATH="$scratch" TMPDIR="$scratch" \
      make "$1" DESTDIR="$stage" PREFIX="$opt" PROGRAM_PREFIX="$prefix" >"$scratch/made" 2>&1 ||
      { cat "$scratch/made" && complain "make $1 fails"; }
  }
  # What others have there stays; also in a folder whose name is the first word of this one.
  others="bin/smoother share/man/man1/other share/doc/rolling/mine"
  for file in $others; do install -D /dev/null "$root/$file"; done
  install -D /dev/null "$stage/a/mine"
  put install

  for source in cmd/*.cpp; do
    plain=$(basename "$source" .cpp) tool=$prefix$(basename "$source" .cpp)
    [ "$("$root/bin/$tool" --version)" = "$tool (rolling) $(bin/smooth --version | cut -d ' ' -f 3)" ] || complain "$tool --version does not name it"
    "$root/bin/$tool" --help | grep -q "^Usage: $tool " || complain "$tool --help does not name it"
    [ "$("$root/bin/$tool" --no-such-option 2>&1 | cut -d : -f 1)" = "$tool" ] ||
      complain "$tool does not name itself in a message"
    [ "$(head -n 1 "$root/share/zsh/site-functions/_$tool")" = "#compdef $tool" ] ||
      complain "zsh does not complete $tool"
    grep -q "^complete .* $tool " "$root/share/bash-completion/completions/$tool" ||
      complain "bash does not complete $tool"
    page=$root/share/man/man1/$tool.1
    [ "$(sed -n 2p "$page")" = ".Dt $(upper "$tool") 1" ] ||
      complain "the title of $page is $(sed -n 2p "$page")"
    if command -v man >/dev/null; then
      found=$(man -M "$root/share/man" -w "$tool") && [ "$found" -ef "$page" ] ||
        complain "man finds ${found:-nothing} for $tool"
      [ -z "$prefix" ] || ! man -M "$root/share/man" -w "$plain" >/dev/null 2>&1 ||
        complain "man finds a page $plain"
    fi
    # A page refers to what is there: with the prefix too.
    while read -r name section; do
      case $name in awk | sed | sort | gnuplot) continue ;; esac
      [ -r "$root/share/man/man$section/$name.$section" ] ||
        complain "$page refers to $name($section), which is not installed"
    done < <(grep -ohE 'Xr [^ ]+ [1-8]' "$page" "$root"/share/man/man[57]/* | cut -d ' ' -f 2,3 | sort -u)
  done
  [ "$(find "$root/bin" -name "${prefix}*" ! -name smoother -type f -perm 755 | wc -l)" = "$(find cmd -name '*.cpp' | wc -l)" ] || complain "other programs than those of cmd/: $(ls "$root/bin")"
  [ -z "$(find "$root/share" -type f ! -name mine ! -name other ! -name '*.sh' ! -perm 644)" ] ||
    complain "modes: $(find "$root/share" -type f ! -perm 644)"
  # They are stripped: no more than a megabyte each.
  [ -z "$(find "$root/bin" -size +1500k)" ] || complain "large programs: $(ls -s "$root/bin")"
  # The words of the history stay: fitpower reads them.
  "$root/bin/${prefix}smooth" -q samples/CR.csv | grep -q '^## smooth v mean width 11$' ||
    complain "${prefix}smooth does not write ## smooth"
  if command -v mandoc >/dev/null; then
    mandoc -Tlint -Wwarning "$root"/share/man/man[157]/*.[157] || complain "the pages are not right"
    tests/house/man-examples.sh "$root" >"$scratch/examples" 2>&1 || { cat "$scratch/examples" &&
      complain "the examples of the installed pages"; }
  fi

  put uninstall
  left=$(cd "$root" && find . -type f | cut -c 3- | sort | xargs)
  [ "$left" = "$(printf '%s\n' $others | sort | xargs)" ] ||
    complain "after uninstall there is $left"
  rm "$root/share/doc/rolling/mine"
  put uninstall
  [ ! -e "$root/share/doc/rolling" ] || complain "uninstall leaves share/doc/rolling"
  [ -e "$stage/a/mine" ] || complain "uninstall deletes a stranger's folder"
  [ ! -e hit ] && [ ! -e "$scratch/hit" ] || { rm -f hit; complain "a name was run as code"; }
done
# Without a PREFIX everything goes below /usr/local.
prefix=''
make install DESTDIR="$scratch/default" >"$scratch/made" 2>&1 || complain "make install fails"
[ "$(cd "$scratch/default" && find . -maxdepth 3 -name bin)" = ./usr/local/bin ] &&
  [ -z "$(find "$scratch/default" -type f ! -path '*/usr/local/*')" ] ||
  complain "make install goes to $(find "$scratch/default" -name bin)"
# A name of a program that could be more than a name is refused, before anything is written.
for prefix in 'r&d-' 'a/b' '-x' 'a b' '$(touch hit)' "'"; do
  if PROGRAM_PREFIX=$prefix PREFIX=/opt DESTDIR=$scratch/none cmd/install/install.sh install \
    2>"$scratch/said"; then complain "is accepted"; fi
  grep -q 'PROGRAM_PREFIX is' "$scratch/said" || complain "is refused by: $(cat "$scratch/said")"
done
if [ -e "$scratch/none" ] || [ -e hit ]; then complain "is refused too late"; fi
version=$(bin/smooth --version | cut -d " " -f 3)
{ grep -qF "version = {$version}" samples/rolling.bib && grep -qxF ".It $version" man/rolling.7; } ||
  { echo "samples/rolling.bib or rolling(7) names another version" && wrong=1; }
exit $wrong
