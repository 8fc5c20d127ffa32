#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Which module may include which: read from the #include "module/..." lines.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
# signal and noise in cli: what a `##` line says becomes a filter of the noise; contact in noise: D is
# an acceleration there
may='base:
text: base
signal: base
selection: base signal
ode: base
contact: base
law: base
motion: base ode contact law
noise: base contact
least_squares: base
statistics: base
fit: base contact law motion noise least_squares statistics
sensor: base motion
cli: base text contact law signal noise statistics fit
report: base text contact selection statistics fit cli'
wrong=0
complain() { echo "$*" && wrong=1; }

awk -v may="$may" '
  function complain(text) { print FILENAME ": " text; wrong = 1 }
  function is(names) { return index(" " names " ", " " module " ") }
  BEGIN {
    n = split(may, line, "\n")
    for (i = 1; i <= n; i++) {
      split(line[i], part, ": *")
      known[part[1]] = " " part[1] " " part[2] " "
    }
  }
  FNR == 1 {
    files++
    split(FILENAME, part, "/")
    module = part[1] == "lib" ? part[2] : "cmd"
    if (module != "cmd" && !(module in known)) complain("a module without a rule; give it one in tests/house/layers.sh")
  }
  /^ *# *include "/ {
    split($0, part, "\"")
    # The module of the file itself is named, too.
    if (!sub(/\/.*/, "", part[2])) complain("an include without its module: " $0)
    else if (module != "cmd" && !index(known[module], " " part[2] " "))
      complain("includes " part[2] "/; it may include:" known[module])
  }
  /# *include <CLI\// && !is("cli") { complain("only lib/cli knows CLI11") }
  /# *include (<gsl\/|"base\/gsl\.h")/ && !is("base ode fit sensor law motion statistics") {
    complain("it does without GSL")
  }
  is("text cli report cmd") { next }
  /# *include <(iostream|fstream|cstdio|stdio\.h|unistd\.h|fcntl\.h)>/ { complain("only lib/text and lib/cli see files") }
  {
    text = $0
    while (match(text, /"([^"\\]|\\.)*"/)) {
      if (substr(text, RSTART, RLENGTH) ~ /--[a-z]/) complain("numeric code knows no option: " $0)
      text = substr(text, RSTART + RLENGTH)
    }
  }
  END { if (files < 20) complain("only " files " files were looked at"); exit wrong }' lib/*/* cmd/*.cpp || wrong=1
exit $wrong
