# SPDX-License-Identifier: GPL-3.0-or-later
# Compares two files field by field, numbers as numbers:
#   awk -v tolerance='1e-12' -f approx.awk expected actual       relative
#   awk -v tolerance='1e-12 1e-15' ...                           and that much absolute besides, for what may be 0
# Comment lines and words must be equal. An expectation without a number fails: it would hold for nothing at all.
function is_number(text) { return text ~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$/ }
function magnitude(x) { return x < 0 ? -x : x }
function complain(text) {
  if (++complaints <= 10) print text
}
BEGIN {
  if (split(tolerance, part, /[ \t]+/) < 1 || !is_number(part[1]) || (part[2] != "" && !is_number(part[2]))) {
    complain("'" tolerance "' is not a tolerance")
    exit
  }
  relative = part[1] + 0
  absolute = part[2] + 0
}
FILENAME == ARGV[1] {
  expected[++lines] = $0
  next
}
{
  if (++line > lines) {
    complain("line " line " is not expected: " $0)
    next
  }
  if ($0 == expected[line] || $0 ~ /^#/ || expected[line] ~ /^#/) {
    if ($0 != expected[line]) complain("line " line ": " $0 "\n   instead of: " expected[line])
    count = split($0, have)
    for (i = 1; i <= count && $0 !~ /^#/; ++i) numbers += is_number(have[i])
    next
  }
  count = split($0, have)
  if (count != split(expected[line], want)) {
    complain("line " line ": " count " fields: " $0 "\n   instead of: " expected[line])
    next
  }
  for (i = 1; i <= count; ++i) {
    if (is_number(want[i]) && is_number(have[i])) {
      ++numbers
      distance = magnitude(have[i] - want[i])
      if (!(distance <= relative * magnitude(want[i]) + absolute))
        complain("line " line ", field " i ": " have[i] " instead of " want[i] ", off by " distance)
    } else if (want[i] != have[i]) {
      complain("line " line ", field " i ": " have[i] " instead of " want[i])
    }
  }
}
END {
  if (line < lines) complain("line " line + 1 " is missing: " expected[line + 1])
  if (!complaints && !numbers) complain("nothing was compared: the expectation has no number")
  exit complaints > 0
}
