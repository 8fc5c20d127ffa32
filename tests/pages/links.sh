#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A tool that calls no GSL does not depend on it.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
command -v ldd >/dev/null || { echo "skipped: no ldd (package libc-bin)" && exit 77; }
wrong=0
for tool in smooth differentiate shift-from-accel; do
  libraries=$(ldd "bin/$tool") || { echo "bin/$tool: ldd does not read it" && exit 1; }
  grep -q 'libc\.so' <<<"$libraries" || { echo "bin/$tool: no libc among: $libraries" && wrong=1; }
  if grep -i gsl <<<"$libraries"; then echo "bin/$tool depends on GSL" && wrong=1; fi
done
# The look itself works: fitpower, which takes probabilities from GSL, shows it. energy-ledger and
# simulate interpolate the table of a law with it.
ldd bin/fitpower | grep -q libgsl ||
  { echo "bin/fitpower does not depend on GSL: is it linked in, and into the others too?" && wrong=1; }
exit $wrong
