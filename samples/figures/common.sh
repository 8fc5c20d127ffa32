# shellcheck shell=bash
# What the figures' scripts share; each sources it first. $1 is gnuplot's terminal, svg (the default) or pngcairo; the picture goes
# to standard output. The tools are on PATH; the scripts work in samples/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
terminal=${1:-svg}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# draw WIDTH HEIGHT [ASSIGNMENTS]: gnuplot on the commands of standard input, after style.gp. The symbols of the two terminals are
# made alike: those of svg are thin, those of pngcairo small.
draw() {
  local options=''
  [ "$terminal" != pngcairo ] || options='pointscale 1.4'
  LC_ALL=C.UTF-8 gnuplot -e "set terminal $terminal $options size $1,$2 font 'sans-serif,14' background 'white'" \
    -e "scratch = '$scratch/'; ${3:-}" figures/style.gp /dev/stdin |
    if [ "$terminal" = svg ]; then sed "/id='gpPt/s/stroke-width='0[.0-9]*'/stroke-width='0.4'/"; else cat; fi
}

# The one row of columns on standard input as assignments that gnuplot, awk and bc take: v = 0.5; D = 0.0016; ...
assignments() {
  awk -F'\t' '/^# / { sub(/^# /, ""); for (i = 1; i <= NF; i++) { name[i] = $i; sub(/\[.*/, "", name[i]) }; next }
    !/^#/ { for (i = 1; i <= NF; i++) printf "%s = %s; ", name[i], $i }'
}

# scene FILE: its mass, radius and shape factor, likewise.
scene() { sed -n 's/^mass *=/m =/p; s/^radius *=/R =/p; s/^shape-factor *=/K =/p' "$1" | tr '\n' ';'; }

# The records of smooth -w 11 whose windows are whole: its first and last five means are noisier.
whole_windows() { awk '/^#/ { print; next } { row[++n] = $0 } END { for (i = 6; i <= n - 5; i++) print row[i] }'; }
