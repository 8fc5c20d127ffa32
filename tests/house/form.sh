#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The form of the tree and of the code: the top level, the lengths of files, functions and lines, a
# header for each source, and the licence line at the top of each file that is code or a page.
#
#   tests/house/form.sh            complains
#   tests/house/form.sh table      prints the figures of each part instead
#
# A function is counted from the first line of its signature to the line that closes its body:
# clang-format puts both at the same indentation.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
wrong=0
complain() { echo "$*" && wrong=1; }

# LENGTH FILE:LINE of each function at the indentation of a file or of a class.
functions() {
  awk '
    FNR == 1 { delete begin }
    /^(  )?[^ \/#]/ {
      match($0, /^ */)
      if (substr($0, RLENGTH + 1, 1) != "}") {
        begin[RLENGTH] = FNR
        if (/^ *(namespace|class|struct|enum|union) |= (\[.*)?\{+$|\]\(.*\{$/) delete begin[RLENGTH]
      } else {
        if (RLENGTH in begin) print FNR - begin[RLENGTH] + 1, FILENAME ":" begin[RLENGTH]
        delete begin[RLENGTH]
      }
    }' "$@"
}

if [ "${1:-}" = table ]; then
  printf '%-10s %5s %6s %16s %14s %8s\n' part files lines 'longest function' 'lines over 100' includes
  for part in cmd lib/*; do
    mapfile -t files < <(find "$part" -name '*.cpp' -o -name '*.h')
    printf '%-10s %5d %6d %16d %14d %8d\n' "${part#lib/}" "${#files[@]}" "$(cat "${files[@]}" | wc -l)" \
      "$(functions "${files[@]}" | sort -n | tail -n 1 | cut -d ' ' -f 1)" \
      "$(cat "${files[@]}" | grep -cE '.{101}')" \
      "$(sed -nE 's|^#include "([^/"]+)/.*|\1|p' "${files[@]}" | grep -vx "${part#lib/}" | sort -u | wc -l)"
  done
  exit
fi

# A file that a command of somebody left there would be given away.
for entry in $(git ls-files 2>/dev/null | cut -d / -f 1 | sort -u); do
  case $entry in
    .* | Makefile | cmd | lib | tests | samples | man | README.md | LICENSE) ;;
    *) complain "$entry does not belong to the top level" ;;
  esac
done

mapfile -t files < <(find cmd lib tests -name '*.cpp' -o -name '*.h')
while read -r place; do
  complain "$place: a line of more than 100 characters"
done < <(LC_ALL=C.UTF-8 grep -HnoE '^.{101}' "${files[@]}" | cut -d : -f 1,2)

while read -r length file; do
  [ "$length" -le 400 ] || complain "$file: $length lines; at most 400"
done < <(find cmd lib tests -type f \( -name '*.cpp' -o -name '*.h' -o -name '*.sh' -o -name '*.awk' \
  -o -name '*.py' \) -exec wc -l {} + | grep -v ' total$')

count=0
while read -r length place; do
  count=$((count + 1))
  [ "$length" -le 60 ] || complain "$place: a function of $length lines; at most 60"
done < <(functions cmd/*.cpp lib/*/*)
[ "$count" -gt 300 ] || complain "only $count functions were found"

for source in lib/*/*.cpp; do
  # x_y.cpp may be a part of what x.h declares.
  [ -e "${source%.cpp}.h" ] || [ -e "${source%_*}.h" ] || complain "$source has no header"
done

mapfile -t files < <(find Makefile .ci/run tests/faults/tools cmd lib man tests samples -type f \( \
  -path 'man/*.[157]' -o -name '*.cpp' -o -name '*.h' -o -name '*.sh' -o -name '*.awk' \
  -o -name '*.gp' -o -name '*.py' -o -name '*.mk' -o -name Makefile -o -name run -o -name tools \) \
  ! -path '*/records/*' ! -path '*/results/*')
while IFS= read -r file; do
  complain "$file does not begin with its licence, or have it behind its #! line"
done < <(awk '
  FNR == 1 {
    mark = FILENAME ~ /[.](cpp|h)$/ ? "//" : FILENAME ~ /^man\// ? ".\\\"" : "#"
    if (/^#!/) next
  }
  $0 != mark " SPDX-License-Identifier: GPL-3.0-or-later" { print FILENAME }
  { nextfile }' "${files[@]}")
count=${#files[@]}
[ "$count" -gt 400 ] || complain "only $count files were found"

if command -v clang-format-14 >/dev/null; then
  while IFS= read -r file; do
    complain "$file is not as clang-format-14 leaves it"
  done < <(find lib cmd tests \( -name '*.cpp' -o -name '*.h' \) \
    -exec clang-format-14 --dry-run {} + 2>&1 |
    sed -n 's/:[0-9]*:[0-9]*: warning: .*//p' | sort -u)
fi
exit $wrong
