#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# live.sh -K K -R R [-w WIDTH] [-c x|v] [-T TERMINAL] SOURCE: draws D against v while the body rolls, anew
# with every row. SOURCE is the device of a sensor (a serial port), a file that grows, or - for standard
# input. Its lines have time and velocity (-c v, the default) or time and position (-c x). TERMINAL is one
# of gnuplot's (qt or x11 on a graphic screen, else dumb, which draws with letters). The picture is
# (WIDTH - 1)/2 + 1 rows behind the sensor, one more with -c x.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/../script.sh"
w=11 c=v
options '-K -R -w -c -T' "$@"
width=$w column=$c terminal=$T
set -- ${operands[@]+"${operands[@]}"}
[ "$K" ] && [ "$R" ] || wrong 'say what rolled: -K 0.5 -R 0.04'
[ $# = 1 ] || wrong 'say one source: a device, a file that grows, or -'
[ "$1" = - ] || [ -r "$1" ] || wrong "$1: there is no such device or file that can be read"
is_count "$width" || wrong "-w $width: a whole number"
case $column in x | v) ;; *) wrong "-c $column: x or v" ;; esac
command -v gnuplot >/dev/null ||
  wrong 'gnuplot is not installed; make setup figures installs it'
if [ -z "$terminal" ]; then
  terminal=dumb
  if [ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ]; then
    for name in x11 qt; do
      ! gnuplot -d -e "set terminal $name" 2>/dev/null || terminal=$name
    done
  fi
fi

rows() {
  if [ "$1" = - ]; then
    [ ! -t 0 ] || stty raw -echo
    cat
  elif [ -c "$1" ]; then
    stty raw -echo <"$1"
    cat -- "$1"
  else
    tail -n +1 -F -- "$1" 2>/dev/null &
    trap 'kill $!' EXIT  # with this script
    while kill -0 $$ 2>/dev/null; do sleep 1; done
  fi
}
# The commands of gnuplot, with each row all points so far. (awk would read ahead.)
pictures() {
  local points='' v=0 D=0 i field
  if [ "$terminal" = dumb ]; then
    echo 'set terminal dumb size 78, 22; set print "-"; set style line 1 pt "o"'
  else
    echo "set terminal $terminal noraise; set style line 1 pt 7"
  fi
  echo 'set xlabel "v / (m/s)"; set ylabel "D / mm"; set xrange [0:*]; set yrange [0:*]'
  while IFS=$'\t' read -r -a field; do
    case ${field[0]-} in
      '# t'*)
        for i in "${!field[@]}"; do
          case ${field[i]} in v\[*) v=$i ;; D\[*) D=$i ;; esac
        done ;;
      [0-9.-]*)
        points+="${field[v]} ${field[D]}"$'\n'
        [ "$terminal" != dumb ] || echo 'print "\033[H\033[J"'
        printf 'plot "-" using (abs($1)):(($1<0?-1e3:1e3)*$2) with points ls 1 notitle\n%se\n' "$points" ;;
    esac
  done
}
velocity() { if [ "$column" = x ]; then differentiate -u -c x; else cat; fi; }
rows "$1" | velocity | smooth -q -u -c v -w "$width" | differentiate -u -c v |
  shift-from-accel -q -u -K "$K" -R "$R" |
  pictures | gnuplot -d -
