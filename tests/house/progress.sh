#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What takes more than two seconds says at a terminal how far it is, and wipes that; not what is
# quick, nor with -q, nor into a file.
set -u
export LC_ALL=C
unset CDPATH
script -qec 'test -t 2' /dev/null </dev/null >/dev/null 2>&1 ||
  { echo "skipped: no terminal could be made (script of package bsdutils)" && exit 77; }
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 2
wrong=0
at_terminal() { script -qec "$1" /dev/null </dev/null | tr '\r\033' '>^'; }
silent() { [ -z "$("${@:2}")" ] || { echo "$1: $("${@:2}")" && wrong=1; }; }
wipe='>^[K'

awk 'BEGIN { print "# t\tv"; for (i = 0; i < 100000; i++) printf "%.2f\t%.4f\n", i / 25, 0.5 + sin(i / 1000) / 4 }' >big
slow_reader='(sleep 4; cat >/dev/null)'
said=$(at_terminal "smooth big | $slow_reader")
[[ $said == "${wipe}smooth: big "[1-9]*" %, 2 s$wipe"*"$wipe" ]] ||
  { echo "smooth says '$said'" && wrong=1; }
said=$(at_terminal "smooth <big | $slow_reader")
[[ $said == *"smooth: standard input "* ]] ||
  { echo "smooth of its standard input says '$said'" && wrong=1; }
silent 'with -q' at_terminal "smooth -q big | $slow_reader"
silent 'quick' at_terminal 'smooth big >out'
grep -q __asan_init "$(command -v smooth)" ||  # which needs more memory
  silent 'without memory for a thread' at_terminal '(ulimit -s 200000 && ulimit -v 100000; smooth big >out) || echo "exit $?"'
into_file() { smooth big 2>err | { sleep 3; cat >/dev/null; }; cat err; }
silent 'into a file' into_file

# Whoever reads from the terminal is told so, and ends the columns by Ctrl-D.
typed() { { printf "$1" && sleep 1 && printf '\004'; } | script -qec "$2" /dev/null | tr -d '\r'; }
said=$(typed '# t v\n0 1\n1 2\n' 'smooth -w 1')
[[ $said == *'smooth: reading columns from the terminal; end with Ctrl-D'*$'\n0\t1\n1\t2' ]] ||
  { echo "at a terminal smooth says '$said'" && wrong=1; }
said=$(typed 'v D\n0.1 1e-3\n0.6 1e-3\n' 'simulate -K 0.5 -R 0.04 --v0 0.5 --dt 9 --law -')
[[ $said == *'simulate: reading columns from the terminal; end with Ctrl-D'*'## simulate table'* ]] ||
  { echo "at a terminal simulate --law - says '$said'" && wrong=1; }
said=$(typed '# t v\n0 1\n1 2\n' 'smooth -q -w 1')
[[ $said != *'Ctrl-D'* ]] || { echo "at a terminal smooth -q says '$said'" && wrong=1; }

# Fits of one run each, as many as take three seconds.
roll=$(simulate -K 0.5 -R 0.04 -a 1.87e-3 -b 0.215 --v0 0.5 --dt 0.04 --columns t,x --digits 3)
for ((runs = 300; ; runs *= 2)); do
  for ((i = 0; i < runs; i++)); do printf '%s\n\n' "$roll"; done >runs
  SECONDS=0
  said=$(at_terminal 'fitpower --each --route position -K 0.5 -R 0.04 runs >out')
  [ "$SECONDS" -lt 4 ] || break
done
[[ $said == "${wipe}fitpower: fitting "[0-9]*" %, 2 s$wipe"*"$wipe" ]] ||
  { echo "fitpower of $runs runs says '$said'" && wrong=1; }
said=$(at_terminal 'fitpower --each --route position -K 0.5 -R 0.04 runs' | head -n 1)  # and its rows on the terminal too
[[ $said == *"$wipe# a[m]"* ]] || { echo "before its rows fitpower says '$said'" && wrong=1; }
exit $wrong
