#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages are right mdoc: every warning is an error. No page is longer than its limit.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it" && exit 77; }
[ -n "$(ls man/*.[1-8] 2>/dev/null)" ] || { echo "no pages in man/" && exit 1; }
mandoc -Tlint -Wwarning man/*.[1-8] || failed=1
# A Dq or Sq runs to the end of its line: a second one on it stands within the first.
for page in man/*.[1-8]; do
  # shellcheck disable=SC1112
  nested=$(mandoc -Tutf8 "$page" | sed 's/.\x08//g' | grep -nE '“[^”]*“|‘[^’]*‘|””|’’')
  [ -z "$nested" ] || { printf '%s: quotes within quotes:\n%s\n' "$page" "$nested"; failed=1; }
done

# The words of each page, as rendered: who adds some takes others away.
while read -r page limit; do
  words=$(mandoc -Tascii "man/$page" | sed 's/.\x08//g' | wc -w)
  [ "$words" -gt 500 ] && [ "$words" -le "$limit" ] ||
    { echo "man/$page has $words words; it may have 500 to $limit" && failed=1; }
  limited+=" man/$page"
done <<'END'
differentiate.1 1504
energy-ledger.1 1670
fitpower.1 1444
rolling-columns.5 2000
rolling-fits.7 2500
rolling-motion.7 2200
rolling-recipes.7 2000
rolling.7 2000
shift-from-accel.1 993
simulate.1 1479
smooth.1 1472
END
[ "$limited" = "$(printf ' %s' man/*.[1-8])" ] || { echo "not the pages that have a limit: $(echo man/*.[1-8])" && failed=1; }
exit "${failed:-0}"
