#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make install` with plain and with prefixed names: the tools run, the pages are found and are
# right, their examples run under the installed names; `make uninstall` removes all of it and
# nothing else. Both whatever the environment is and whatever signs the folder has in its name.
# What others have put there is never replaced or removed, and what is the user's own is not copied.
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
    [ "$("$root/bin/$tool" --version)" = "$tool $(bin/smooth --version | cut -d ' ' -f 2-)" ] || complain "$tool --version does not name it"
    "$root/bin/$tool" --help | grep -q "^Usage: $tool " || complain "$tool --help does not name it"
    [ "$("$root/bin/$tool" --no-such-option 2>&1 | cut -d : -f 1)" = "$tool" ] ||
      complain "$tool does not name itself in a message"
    [ "$(head -n 1 "$root/share/zsh/site-functions/_$tool")" = "#compdef $tool" ] ||
      complain "zsh does not complete $tool"
    grep -q "^complete .* $tool " "$root/share/bash-completion/completions/$tool" ||
      complain "bash does not complete $tool"
    grep -q "^complete -c $tool " "$root/share/fish/vendor_completions.d/$tool.fish" ||
      complain "fish does not complete $tool"
    page=$root/share/man/man1/$tool.1
    [ "$(grep '^\.Dt' "$page")" = ".Dt $(upper "$tool") 1" ] ||
      complain "the title of $page is $(grep '^\.Dt' "$page")"
    if command -v man >/dev/null; then
      found=$(man -M "$root/share/man" -w "$tool") && [ "$found" -ef "$page" ] ||
        complain "man finds ${found:-nothing} for $tool"
      [ -z "$prefix" ] || ! man -M "$root/share/man" -w "$plain" >/dev/null 2>&1 ||
        complain "man finds a page $plain"
    fi
  done
  # A page refers to what is there: with the prefix too.
  while read -r name section; do
    case $name in awk | sed | sort | gnuplot) continue ;; esac
    [ -r "$root/share/man/man$section/$name.$section" ] ||
      complain "a page refers to $name($section), which is not installed"
  done < <(grep -ohE 'Xr [^ ]+ [1-8]' "$root"/share/man/man[157]/* | cut -d ' ' -f 2,3 | sort -u)
  [ "$(find "$root/bin" -name "${prefix}*" ! -name smoother -type f -perm 755 | wc -l)" = "$(find cmd/*.cpp | wc -l)" ] || complain "other programs than those of cmd/: $(ls "$root/bin")"
  [ -z "$(find "$root/share" -type f ! -name mine ! -name other ! -name '*.sh' ! -perm 644)" ] ||
    complain "modes: $(find "$root/share" -type f ! -perm 644)"
  for program in "$root/bin/${prefix}"*; do
    nm "$program" 2>/dev/null | grep -q ' [TtBbDd] ' && complain "$program is not stripped"
  done
  # The words of the history stay: fitpower reads them.
  "$root/bin/${prefix}smooth" -q samples/CR.csv | grep -q '^## smooth v mean width 11$' ||
    complain "${prefix}smooth does not write ## smooth"
  if command -v mandoc >/dev/null; then
    mandoc -Tlint -Wwarning "$root"/share/man/man[157]/*.[157] || complain "the pages are not right"
    [ -z "$prefix" ] || [ -z "${LONG-}" ] || tests/pages/man-examples.sh "$root" >"$scratch/examples" 2>&1 || { cat "$scratch/examples" &&
      complain "the examples of the installed pages"; }
  fi

  put uninstall
  left=$(cd "$root" && find . -type f | cut -c 3- | sort | xargs)
  [ "$left" = "$(printf '%s\n' $others | sort | xargs)" ] ||
    complain "after uninstall there is $left"
  [ "$(ls -A "$root/share/doc/rolling")" = mine ] || complain "uninstall leaves folders of samples"
  [ -e "$stage/a/mine" ] || complain "uninstall deletes a stranger's folder"
  # Of folders those that hold what others have put there.
  folders=$(cd "$root" && find . -type d | sort | xargs)
  [ "$folders" = '. ./bin ./share ./share/doc ./share/doc/rolling ./share/man ./share/man/man1' ] ||
    complain "after uninstall there are $folders"
  [ ! -e hit ] && [ ! -e "$scratch/hit" ] || { rm -f hit; complain "a name was run as code"; }
done
# Without a PREFIX everything goes below /usr/local.
prefix=''
make install DESTDIR="$scratch/default" >"$scratch/made" 2>&1 || complain "make install fails"
[ "$(cd "$scratch/default" && find . -maxdepth 3 -name bin)" = ./usr/local/bin ] &&
  [ -z "$(find "$scratch/default" -type f ! -path '*/usr/local/*')" ] ||
  complain "make install goes to $(find "$scratch/default" -name bin)"
# The GNU variables, each by itself.
make install DESTDIR="$scratch/gnu" prefix=/p bindir=/b datadir=/d mandir=/m docdir=/doc \
  >"$scratch/made" 2>&1 || complain "make install with directories fails: $(cat "$scratch/made")"
for file in b/smooth m/man1/smooth.1 d/bash-completion/completions/smooth doc/samples/CR.csv; do
  [ -s "$scratch/gnu/$file" ] || complain "make install does not make $file"
done
[ ! -e "$scratch/gnu/p" ] || complain 'make install makes the prefix that nothing is in'

# The samples are those of the source, and nothing of the user's.
if git ls-files --error-unmatch samples/table1.sh >/dev/null 2>&1; then
  diff <(git ls-files samples | while read -r file; do [ ! -f "$file" ] || echo "$file"; done) \
    <(cd "$scratch/gnu/doc" && find samples -type f | sort) || complain 'other samples are installed'
fi
copy=$scratch/copy
mkdir "$copy" && tar -cf - Makefile cmd man samples tests/targets.mk | tar -xf - -C "$copy"
ln -s "$PWD/bin" "$copy/bin"
mkdir -p "$copy/samples/lab/records" "$copy/samples/lab/results" "$copy/samples/mine"
for file in lab/records/0001.csv lab/results/a.sh mine/run.sh my.csv my.toml .hidden; do
  echo own >"$copy/samples/$file"
done
run_there() {  # install | uninstall, into $scratch/there
  bindir=/b mandir=/m datadir=/d docdir=/doc TOOLS=bin DESTDIR=$scratch/there \
    PROGRAM_PREFIX=${2-} "$copy/cmd/install/install.sh" ${1:+"$1"} >"$scratch/out" 2>"$scratch/said"
  local status=$?
  cat "$scratch/out" >>"$scratch/said"
  return $status
}
run_there ''
[ $? = 2 ] && [ ! -e "$scratch/there" ] || complain "install.sh without a word: $(find "$scratch/there")"
run_there install || complain "install.sh: $(cat "$scratch/said")"
own=$(cd "$scratch/there/doc" && find . -name '0001.csv' -o -name 'my.*' -o -name 'run.sh' -o -name a.sh)
[ -z "$own" ] || complain "install copies $own"

# Whatever the umask of who installs is, everybody can read it.
rm -rf "$scratch/there" && (umask 077 && run_there install)
closed=$(find "$scratch/there/doc" "$scratch/there/b" "$scratch/there/m" "$scratch/there/d" ! -perm -444)
[ -z "$closed" ] || complain "others cannot read $closed"

# Again, and in a newer version with a file less: no complaint, and the file goes.
rm "$copy/samples/run.svg" && echo '# newer' >>"$copy/samples/table1.sh"
run_there install || complain "a second install: $(cat "$scratch/said")"
grep -q '^# newer' "$scratch/there/doc/samples/table1.sh" || complain 'a newer version is not installed'
[ ! -e "$scratch/there/doc/samples/run.svg" ] || complain 'what a newer version lacks stays'
# With another prefix beside it: what both have stays until both are gone.
run_there install r- && run_there uninstall || complain "two prefixes: $(cat "$scratch/said")"
[ -x "$scratch/there/b/r-smooth" ] && [ ! -e "$scratch/there/b/smooth" ] &&
  [ -s "$scratch/there/doc/samples/CR.csv" ] || complain "of two prefixes: $(ls "$scratch/there/b")"
run_there uninstall r-
[ -z "$(ls -A "$scratch/there")" ] ||
  complain "of two: $(find "$scratch/there")"

# A stranger's program or link of the same name, and a sample that was changed: nothing is written;
# and what was changed after it was installed stays.
for stranger in b/simulate doc/samples/CR.csv m/man1/smooth.1; do
  for kind in file link; do
    rm -rf "$scratch/there" && mkdir -p "$scratch/there/${stranger%/*}"
    echo stranger >"$scratch/elsewhere"
    if [ $kind = file ]; then cp "$scratch/elsewhere" "$scratch/there/$stranger"
    else ln -s "$scratch/elsewhere" "$scratch/there/$stranger"; fi
    run_there install && complain "install replaces a stranger's $stranger"
    [ ! -s "$scratch/out" ] || complain "install says it on standard output: $(cat "$scratch/out")"
    grep -qF "$scratch/there/$stranger" "$scratch/said" || complain "install says $(cat "$scratch/said")"
    [ "$(find "$scratch/there" ! -type d)" = "$scratch/there/$stranger" ] &&
      [ "$(cat "$scratch/elsewhere" "$scratch/there/$stranger" | sort -u)" = stranger ] ||
      complain "install has written beside or over a stranger's $stranger"
    run_there uninstall
    [ -e "$scratch/there/$stranger" ] || complain "uninstall deletes $stranger, which it never installed"
  done
done
rm -rf "$scratch/there"
run_there install && rm "$scratch/there/b/smooth" && echo other >"$scratch/there/b/smooth"
run_there uninstall
[ "$(cat "$scratch/there/b/smooth")" = other ] && grep -q 'smooth is not as it was' "$scratch/said" ||
  complain "uninstall deletes another's smooth: $(cat "$scratch/said")"

# A name of a program that could be more than a name is refused, before anything is written.
for prefix in 'r&d-' 'a/b' '-x' 'a b' '$(touch hit)' "'"; do
  if PROGRAM_PREFIX=$prefix bindir=/b mandir=/m datadir=/d docdir=/doc TOOLS=bin \
    DESTDIR=$scratch/none cmd/install/install.sh install 2>"$scratch/said"; then
    complain "is accepted"
  fi
  grep -q 'PROGRAM_PREFIX is' "$scratch/said" || complain "is refused by: $(cat "$scratch/said")"
done
if [ -e "$scratch/none" ] || [ -e hit ]; then complain "is refused too late"; fi
version=$(bin/smooth --version | cut -d " " -f 3)
version=${version%+*}  # without the commit
{ grep -qF "version = {$version}" samples/rolling.bib && grep -qxF ".It $version" man/rolling.7; } ||
  { echo "samples/rolling.bib or rolling(7) names another version" && wrong=1; }
exit $wrong
