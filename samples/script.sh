# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=sh
# What the scripts of samples share. Each sources it behind `set`, LC_ALL and CDPATH:
#
#   . "$(dirname "$0")/script.sh"
#
# It prints the comment at the top of the script for -h and --help, puts the tools of this source
# before those on the PATH, and has the functions below.
help() { sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$0"; }
case ${1-} in -h | --help) help; exit ;; esac
PATH=$(cd "$(dirname "$0")" && while [ ! -e script.sh ]; do cd ..; done && cd .. && pwd)/bin:$PATH

wrong() { printf '%s: %s\n' "${0##*/}" "$1" >&2; exit 2; }
is_count() { case $1 in '' | *[!0-9]* | ?????????*) false ;; esac; }
is_number() { printf '%s\n' "$1" | grep -qxE '[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?'; }
# A folder of this run, $scratch, which is removed when it ends. Nothing else is.
make_scratch() {
  scratch=$(mktemp -d) && [ -d "$scratch" ] || wrong 'mktemp makes no folder: see TMPDIR'
  case $scratch in /*) ;; *) scratch=$PWD/$scratch ;; esac
  trap 'rm -rf "$scratch"' EXIT
  trap 'exit 130' INT TERM
}
