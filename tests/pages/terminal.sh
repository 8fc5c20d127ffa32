#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Whoever reads from the terminal is told so, and ends the columns by Ctrl-D.
set -u
export LC_ALL=C
unset CDPATH
script -qec 'test -t 2' /dev/null </dev/null >/dev/null 2>&1 ||
  { echo "skipped: no terminal could be made (script of package bsdutils)" && exit 77; }
wrong=0
typed() { { printf "$1" && sleep 1 && printf '\004'; } | script -qec "$2" /dev/null | tr -d '\r'; }
said=$(typed '# t v\n0 1\n1 2\n' 'smooth -w 1')
[[ $said == *'smooth: reading columns from the terminal; end with Ctrl-D'*$'\n0\t1\n1\t2' ]] ||
  { echo "at a terminal smooth says '$said'" && wrong=1; }
said=$(typed 'v D\n0.1 1e-3\n0.6 1e-3\n' 'simulate -K 0.5 -R 0.04 --v0 0.5 --dt 9 --law -')
[[ $said == *'simulate: reading columns from the terminal; end with Ctrl-D'*'## simulate table'* ]] ||
  { echo "at a terminal simulate --law - says '$said'" && wrong=1; }
said=$(typed '# t v\n0 1\n1 2\n' 'smooth -q -w 1')
[[ $said != *'Ctrl-D'* ]] || { echo "at a terminal smooth -q says '$said'" && wrong=1; }
exit $wrong
