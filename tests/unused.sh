#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Functions of lib/ that no tool calls: what is left when the linker has dropped the unused sections
# of a build without inlining. Inline functions that nothing calls are never compiled, and not seen.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export scratch CXX=${CXX:-g++}

printf '%s\n' lib/*/*.cpp cmd/*.cpp | xargs -P "$(nproc)" -I {} sh -c \
  '$CXX -O0 -fno-inline -ffunction-sections -ffp-contract=off -std=c++20 -Ilib -c -o "$scratch/$(echo {} | tr / _).o" {}'
for tool in cmd/*.cpp; do
  # shellcheck disable=SC2086  # words, as ccache g++
  $CXX -Wl,--gc-sections -o "$scratch/tool" "$scratch/$(echo "$tool" | tr / _).o" "$scratch"/lib_*.o \
    -lgsl -lgslcblas -lfmt -lm
  nm --defined-only "$scratch/tool" | awk '{ print $3 }'
done | sort -u >"$scratch/used"
nm --defined-only "$scratch"/lib_*.o | awk '$2 ~ /[TtWw]/ && $3 ~ /^_ZNK?(7rolling|12_GLOBAL)/ { print $3 }' |
  sort -u | comm -23 - "$scratch/used" | c++filt | grep -Ev '~|::operator=|lambda' >"$scratch/unused" || true
[ ! -s "$scratch/unused" ] || { echo 'no tool calls:'; cat "$scratch/unused"; exit 1; }
