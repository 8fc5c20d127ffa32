#!/bin/bash
# `make html`: every manual page is there, is in the index, and each link within the site leads to a
# page and a place in it that exist.
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
  about=$(sed -n 's/^\.Nd //p' "$page" | sed 's/\\-/-/g')
  [ "$(grep -cF ">$about</td>" index.html)" = 1 ] || complain "$name: '$about' is not in the index"
done
links=0
while IFS=: read -r file link; do
  target=${link#href=\"}
  target=${target%\"}
  case $target in https://*) continue ;; esac
  links=$((links + 1))
  page=${target%%#*} place=
  [[ $target != *#* ]] || place=${target#*#}
  [ -n "$page" ] || page=$file
  [ -s "$page" ] || { complain "$file links to $target" && continue; }
  [ -z "$place" ] || grep -qF "id=\"$place\"" "$page" || complain "$file links to no place $target"
done < <(grep -oH 'href="[^"]*"' ./*.html)
[ "$links" -gt 50 ] || complain "only $links links"
exit $wrong
