#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `make html`: every manual page is there, in English, with one viewport, and is in the index; each
# link leads to a page of the site, and to a place in it, that exist, or to a page or a site that
# this project does not have.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it"; exit 77; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }
cmd/install/html.sh "$scratch/a site's" || complain "html.sh: exit $?"
cd "$scratch/a site's" || exit 2
for page in "$OLDPWD"/man/*.[157]; do
  name=$(basename "$page")
  [ -s "$name.html" ] || complain "no page $name"
  grep -qF "href=\"$name.html\"" index.html || complain "$name is not in the index"
  about=$(sed -n 's/^\.Nd //p' "$page" | sed 's/\\-/-/g; s/\\(ha/^/g')
  [ "$(grep -cF ">$about</td>" index.html)" = 1 ] || complain "$name: '$about' is not in the index"
  [ "$(grep -cF "<title>${name%.*}(${name##*.}): $about</title>" "$name.html")" = 1 ] ||
    complain "$name: '$about' is not its title"
done
! grep -n '\\' index.html || complain 'the index has escapes of roff'
# Options stand in an element that no line breaks.
! grep -nE '<code class="Li">[a-z ]*--[a-z]' ./*.[157].html || complain 'an option that a line may break'
grep -qF '<span class="option">--coast</span>' smooth.1.html || complain 'smooth(1): no option is whole'
for page in ./*.html; do
  [ "$(grep -c '<html lang="en">' "$page")" = 1 ] || complain "$page does not say its language once"
  [ "$(grep -c 'name="viewport"' "$page")" = 1 ] || complain "$page has not one viewport"
done

# leads FILE TARGET: whether the target of a link in FILE is as it should be.
leads() {
  local file=$1 target=$2 page=${2%%#*} place=''
  case $target in
    https://manpages.debian.org/*)
      [ ! -e "${target##*/}.html" ] || complain "$file: $target is a page of this site"
      return ;;
    https://doi.org/10.*/* | https://github.com/*/*) return ;;
    *:*) complain "$file links to $target: where is that?"; return ;;
  esac
  [[ $target != *#* ]] || place=${target#*#}
  [ -n "$page" ] || page=$file
  [ -s "$page" ] || { complain "$file links to $target" && return; }
  [ -z "$place" ] || grep -qF "id=\"$place\"" "$page" || complain "$file links to no place $target"
}
declare -A within=()
while IFS=: read -r file link; do
  target=${link#href=\"}
  target=${target%\"}
  leads "$file" "$target"
  case $target in *.[157].html*) within[$file]=$((${within[$file]:-0} + 1)) ;; esac
done < <(grep -oH 'href="[^"]*"' ./*.html)
for page in ./*.[157].html; do
  [ "${within[$page]:-0}" -gt 3 ] || complain "$page has ${within[$page]:-0} links to other pages"
done

# The check itself sees what it looks for.
said=$(leads ./smooth.1.html https://manpages.debian.org/fitpower.1; leads ./smooth.1.html nowhere.html
  leads ./smooth.1.html fitpower.1.html#nowhere; leads ./smooth.1.html http://else.where)
[ "$(wc -l <<<"$said")" = 4 ] || complain "wrong links pass: $said"
exit $wrong
