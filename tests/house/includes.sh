#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A module is compiled as one source, which would not miss a header that one of its files forgets. Here
# a file needs each header that declares what it uses: by itself or by headers of this project.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
files=(lib/*/*.h lib/*/*.cpp cmd/*.cpp)
awk '
  FILENAME == "-" { used[$1] = $2; next }
  /^ *# *include/ { split($0, part, /[<>"]/); includes[FILENAME] = includes[FILENAME] "\n" part[2] }
  /^ *(#|\/\/)/ { next }
  { for (header in used) if ($0 ~ "(std|fmt)::(" used[header] ")") place[FILENAME, header] = FNR }

  # Adds what a file includes, and what that includes, to a set.
  function reach(file, all,   i, count, part) {
    count = split(includes[file], part, "\n")
    for (i = 2; i <= count; ++i)
      if (!(part[i] in all)) {
        all[part[i]]
        reach("lib/" part[i], all)
      }
  }
  END {
    for (file in includes) {
      split("", all)
      reach(file, all)
      for (header in used)
        if ((file, header) in place && !(header in all)) {
          print file ":" place[file, header] " needs <" header ">"
          wrong = 1
        }
    }
    exit wrong
  }' - "${files[@]}" <<'END'
algorithm ranges::[a-z_]+|(min|max|clamp|sort|fill_n|copy_n|any_of|all_of|none_of|find_if|count_if|nth_element|lower_bound|reverse)\(
array array<
cmath (abs|sqrt|exp|expm1|log|log1p|pow|hypot|fma|floor|ceil|round|trunc|frexp|ldexp|scalbn|nextafter|sin|cos|fmod|isnan|isfinite|signbit|copysign)\(
functional function<
limits numeric_limits<
map map<
memory unique_ptr<|make_unique<
numeric (accumulate|inner_product|iota|midpoint)\(
optional optional<|nullopt
span span[<(]
string string[^_a-z]|to_string\(
string_view string_view
vector vector<
fmt/core.h (format|format_to|runtime)\(
END
