# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# What the scripts of the figures share; each sources it first. They take
#
#   -t svg | pngcairo   the terminal of gnuplot (svg); the picture goes to standard output
#   -K K[,K...] -R R[,R...] --slope S -c x|v --use NAME=COLUMN
#                       as for the tools, where a figure draws runs of your own
#   -h                  print the comment at the top of the script
#
# and leave their operands in "$@". The tools are those of this source, or on the PATH. A script
# works in a folder of its own with copies of the samples, so that no name of a file or folder gets
# into the code of gnuplot.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "${BASH_SOURCE[0]}")/../script.sh"
terminal=svg K='' R='' slope=0 column='' use=()
while getopts t:K:R:c:-: option; do
  # --slope S, and --slope=S.
  if [ "$option" = - ]; then
    option=--${OPTARG%%=*}
    case $OPTARG in
      *=*) OPTARG=${OPTARG#*=} ;;
      slope | use) OPTARG=${!OPTIND-} OPTIND=$((OPTIND + 1)) ;;
    esac
    [ "$OPTARG" ] || option=none
  fi
  case $option in
    t) terminal=$OPTARG ;;
    K) K=$OPTARG ;;
    R) R=$OPTARG ;;
    c) column=$OPTARG ;;
    --slope) slope=$OPTARG ;;
    --use) use+=(--use "$OPTARG") ;;
    *) help >&2; exit 2 ;;
  esac
done
shift $((OPTIND - 1))
case $terminal in svg | pngcairo) ;; *) echo "$0: -t $terminal: svg or pngcairo" >&2; exit 2 ;; esac
command -v gnuplot >/dev/null ||
  { echo "$0: gnuplot is not installed; make setup figures installs it" >&2; exit 2; }
# What rolled in a run of your own is not guessed, nor which of its columns is to be drawn.
own_body() {
  [ "$K" ] && [ "$R" ] || { echo "$0: say what rolled: -K 0.5 -R 0.04" >&2; exit 2; }
  case $column in '' | x | v) ;; *) echo "$0: -c $column: x or v" >&2; exit 2 ;; esac
  case $slope in *[!-+.0-9eE]*)
    echo "$0: --slope $slope: a number, which fitpower --slope fit finds" >&2; exit 2 ;; esac
}
# The rows of a run with their column x or v.
read_run() { smooth -q ${use[@]+"${use[@]}"} -c "$@"; }
make_scratch
figures=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
samples=${figures%/*}
cp "$figures"/*.gp "$samples"/*.csv "$samples"/*.toml "$scratch"
called_from=$PWD
cd "$scratch"

# draw WIDTH HEIGHT [ASSIGNMENTS]: gnuplot on the commands of standard input, after style.gp. $title is
# the title of the SVG, which readers for the blind and browsers tell. A PNG has 240 dots an inch
# where the SVG has 96. The symbols of the two terminals are made alike: those of svg are thin, those
# of pngcairo small.
draw() {
  local size=$1,$2
  [ "$terminal" = svg ] ||
    size="$(($1 * 5 / 2)),$(($2 * 5 / 2)) fontscale 1.95 linewidth 2.5 pointscale 3.2"
  LC_ALL=C.UTF-8 gnuplot -d \
    -e "set terminal $terminal size $size font 'sans-serif,14' background 'white'" \
    -e "${3:-}" style.gp /dev/stdin |
    if [ "$terminal" = svg ]; then
      sed "/id='gpPt/s/stroke-width='0[.0-9]*'/stroke-width='0.4'/
        s|<title>Gnuplot</title>|<title>${title:?}</title>|; s|<title>gnuplot_[^<]*</title>||"
    else
      cat
    fi
}

# The one row of columns on standard input as assignments that gnuplot, awk and bc read:
# v = 0.5; D = 0.0016; ...
assignments() {
  awk -F'\t' '
    /^# / {
      sub(/^# /, "")
      for (i = 1; i <= NF; i++) { name[i] = $i; sub(/\[.*/, "", name[i]) }
      next
    }
    !/^#/ { for (i = 1; i <= NF; i++) printf "%s = %s; ", name[i], $i }'
}

# scene FILE: its mass, radius and shape factor, likewise, without their uncertainties.
scene() {
  sed -n 's/ *+-.*//; s/"//g; s/^mass *=/m =/p; s/^radius *=/R =/p; s/^shape-factor *=/K =/p' "$1" |
    tr '\n' ';'
}

# The rows of smooth -w 11 whose windows are whole: the first and last five means of each run are
# over fewer rows and noisier.
whole_windows() {
  awk '
    function run_ends(  i) { for (i = 6; i <= n - 5; i++) print row[i]; n = 0 }
    /^#/ { if (n) run_ends(); print; next }
    /^$/ { run_ends(); print; next }
    { row[++n] = $0 }
    END { run_ends() }'
}
