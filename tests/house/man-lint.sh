#!/bin/bash
# The pages are right mdoc: every warning is an error.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v mandoc >/dev/null ||
  { echo "skipped: no mandoc; make setup check installs it" && exit 77; }
[ -n "$(ls man/*.[1-8] 2>/dev/null)" ] || { echo "no pages in man/" && exit 1; }
mandoc -Tlint -Wwarning man/*.[1-8]
