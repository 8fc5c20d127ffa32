#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# rename-page.sh PREFIX TOOL... <PAGE: gives the tools their prefix where the page names them, in
# macros and in the commands of examples. `##` lines keep the plain names, as a renamed tool writes
# them. PREFIX has only letters, digits and . _ + -
set -eu
export LC_ALL=C
unset CDPATH
prefix=$1
shift
[ -n "$prefix" ] || exec cat
tools=$(echo "$*" | sed 's/ /|/g; s/-/\\\\?-/g')  # a hyphen may be escaped
upper() { printf '%s\n' "$*" | tr '[:lower:]' '[:upper:]'; }
sed -E "
s/^\\.Dt ($(upper "$tools")) /.Dt $(upper "$prefix")\\1 /
s/^\\.(Nm|Ql) ($tools)( |\$)/.\\1 $prefix\\2\\3/
s/Xr ($tools) 1/Xr $prefix\\1 1/g
s/^($tools): /$prefix\\1: /
/^\\$ /,/^\\.Ed/s/(^\\$ |^ *|\\| |\\{ |\\(|; |do )($tools)( |\$)/\\1$prefix\\2\\3/g
"
