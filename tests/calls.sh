#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Who calls whom in lib/, by the symbols of a build without inlining, each source by itself. No two
# sources of a module call each other in a loop; those of cli may, which hold the parts of a class. And
# no function is left over that no tool calls, when the linker has dropped the sections without a use.
# Inline functions that nothing calls are never compiled, and not seen.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export scratch CXX=${CXX:-g++}

printf '%s\n' lib/*/*.cpp cmd/*.cpp | xargs -P "$(nproc)" -I {} sh -c \
  '$CXX -O0 -fno-inline -ffunction-sections -ffp-contract=off -std=c++20 -Ilib -c -o "$scratch/$(echo {} | tr / _).o" {}'
# tsort puts the sources in order, or names those of a loop.
for module in lib/*/; do
  module=$(basename "$module")
  [ "$module" != cli ] && ls "$scratch/lib_${module}_"*.o >/dev/null 2>&1 || continue
  nm -A "$scratch/lib_${module}_"*.o | awk '
    { split($1, file, ":") }
    $2 ~ /^[TR]$/ { home[$3] = file[1] }
    $2 == "U" { calls[file[1], $3] }
    END {
      for (call in calls) {
        split(call, part, SUBSEP)
        if (part[2] in home) print part[1], home[part[2]]
      }
    }' | tsort >/dev/null
done
for tool in cmd/*.cpp; do
  # shellcheck disable=SC2086  # words, as ccache g++
  $CXX -Wl,--gc-sections -o "$scratch/tool" "$scratch/$(echo "$tool" | tr / _).o" "$scratch"/lib_*.o \
    -lgsl -lgslcblas -lfmt -lm
  nm --defined-only "$scratch/tool" | awk '{ print $3 }'
done | sort -u >"$scratch/used"
nm --defined-only "$scratch"/lib_*.o | awk '$2 ~ /[TtWw]/ && $3 ~ /^_ZNK?(7rolling|12_GLOBAL)/ { print $3 }' |
  sort -u | comm -23 - "$scratch/used" | c++filt | grep -Ev '~|::operator=|lambda' >"$scratch/unused" || true
[ ! -s "$scratch/unused" ] || { echo 'no tool calls:'; cat "$scratch/unused"; exit 1; }
