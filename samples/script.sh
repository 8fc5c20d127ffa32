# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=sh
# The scripts of samples share this file. Each sources it after `set`, LC_ALL and CDPATH:
#
#   . "$(dirname "$0")/script.sh"
#
# For -h and --help it prints the comment at the top of the script, and that of the file $also if that is
# set. It puts the tools of this source before those on the PATH, and has the functions below.
help() {
  for page in "$0" ${also:+"$also"}; do sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$page"; done
}
case ${1-} in -h | --help) help; exit ;; esac
PATH=$(cd "$(dirname "$0")" && while [ ! -e script.sh ]; do cd ..; done && cd .. && pwd)/bin:$PATH

wrong() { printf '%s: %s\n' "${0##*/}" "$1" >&2; exit 2; }
# options LIST ARGUMENT...: reads the options of a script, which bash runs. Of LIST, -K takes a value, and
# K becomes it; --use... takes one each time that it is given, and use becomes a list; --check! takes none,
# and check becomes the number of operands before it. A variable that has a value already keeps it as its
# default.
# The operands become the list operands. -K0.5 and --slope=0.1 are as -K 0.5 and --slope 0.1.
options() {
  # shellcheck disable=SC2086  # words
  known=" $(printf '%s ' $1)" chosen=''
  shift
  eval 'operands=()'
  for option in $known; do
    variable "$option"
    case $option in *...) eval "$name=()" ;; *) eval "$name=\${$name-}" ;; esac
  done
  while [ $# -gt 0 ]; do
    option=$1
    shift
    case $option in
      --) eval 'operands+=("$@")'; return ;;
      -h | --help) help; exit ;;
      --*=*) set -- "${option#*=}" "$@" && option=${option%%=*} ;;
      -[!-]?*) set -- "${option#-?}" "$@" && option=${option%"${option#-?}"} ;;
      -?*) ;;
      *) eval 'operands+=("$option")'; continue ;;
    esac
    variable "$option"
    case $known in
      *" $option! "*) eval "$name=\${$name:-\${#operands[@]}}" && continue ;;
      *" $option "*) [ -z "${1-}" ] || eval "$name=\$1" ;;
      *" $option... "*) [ -z "${1-}" ] || eval "$name+=(\"\$1\")" ;;
      *) wrong "$option is no option; ${0##*/} --help lists them" ;;
    esac
    [ "${1-}" ] || wrong "$option needs a value"
    chosen="$chosen $option"
    shift
  done
}
variable() {
  name=${1#-} && name=${name#-} && name=${name%%[.!]*}
  while [ "$name" != "${name#*-}" ]; do name=${name%%-*}_${name#*-}; done
}
is_count() { case $1 in '' | *[!0-9]* | ?????????*) false ;; esac; }
is_number() { printf '%s\n' "$1" | grep -qxE '[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?'; }
# KEY of a scene: its value, and that with its standard uncertainty: 0.5+-0.005.
given() { sed -n "/^$1 *= */{ s///; s/[\" ]//g; p; }" "$2"; }
value() { sed -n "/^$1 *= */{ s///; s/[\" ]//g; s/+-.*//; p; }" "$2"; }
# of_run LIST I: the value of run number I in a list of K or R.
of_run() {
  case $1 in
    *,*) printf '%s\n' "$1" | cut -d , -f "$2" ;;
    *) printf '%s\n' "$1" ;;
  esac
}
# named FILE NAME: the runs in FILE; a run without a name gets that of the file NAME.
named() {
  grep -q '^## run ' "$1" || printf '## run %s\n' "$(printf %s "${2##*/}" | tr '[:cntrl:]' '?')"
  cat "$1"
}
# columns FILE NAME...: these columns alone.
columns() {
  file=$1
  shift
  awk -F '\t' -v names="$*" '
    BEGIN { n = split(names, want, " ") }
    /^##/ { next }
    /^# / {
      sub(/^# /, "")
      for (i = 1; i <= NF; i++)
        for (j = 1; j <= n; j++) if ($i == want[j] || index($i, want[j] "[") == 1) at[j] = i
      next
    }
    NF { for (j = 1; j <= n; j++) printf "%s%s", $at[j], (j < n ? "\t" : "\n") }' "$file"
}
# window SECONDS FILE LEAST: the odd number of rows that last SECONDS, at least LEAST, at most all rows.
# The times of each run in the file begin anew.
window() {
  columns "$2" t | awk -v width="$1" -v least="$3" '
    NR > 1 && $1 > last { time += $1 - last; steps++ }
    { last = $1 }
    END {
      rows = 2 * int(width * steps / time / 2) + 1
      if (rows < least) rows = least
      if (rows > NR) rows = NR - (NR + 1) % 2
      print rows
    }'
}
# For awk: normal(), by the generator of Park and Miller and the method of Box and Muller. Each awk makes
# the same numbers.
# shellcheck disable=SC2034  # for those who source this
random='function uniform() { seed = seed * 16807 % 2147483647; return seed / 2147483647 }
function normal() { return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()) }
BEGIN { if (!seed) seed = 1 }'
# place FOLDER FILE...: moves the files into the folder, all or none. It replaces others only if $replace
# is set.
place() {
  to=$1
  shift
  for file; do
    [ ! -e "$to/${file##*/}" ] || [ "${replace-}" ] || wrong "$to/${file##*/} exists: choose another folder"
  done
  trap '' INT TERM HUP
  placed=$(mktemp -d "$to/.new.XXXXXX") || wrong "$to cannot be written"
  trap end_by_signal INT TERM HUP
  cp -- "$@" "$placed" || wrong "$to cannot be written"
  mv -f -- "$placed"/* "$to"
}
# make_scratch makes $scratch, a folder of this run. At the end it and files that were not placed are
# removed, and nothing else. A tool that ends at the same moment may leave one more file: then again.
# A second signal may come before it is ignored, and ends the function: each call removes the whole.
end_by_signal() {
  trap '' INT TERM HUP
  remove_scratch
  exit 130
}
remove_scratch() {
  rm -rf "$scratch" ${placed:+"$placed"} 2>/dev/null ||
    { sleep 0.2; rm -rf "$scratch" ${placed:+"$placed"}; }
}
make_scratch() {
  trap '' INT TERM HUP  # not before the folder has its name
  scratch=$(mktemp -d) && [ -d "$scratch" ] || wrong 'mktemp makes no folder: see TMPDIR'
  placed=''
  trap remove_scratch EXIT
  trap end_by_signal INT TERM HUP
  case $scratch in /*) ;; *) scratch=$PWD/$scratch ;; esac
}
