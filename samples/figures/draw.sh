# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034
# Options of every figure; all but -t are for your own runs, a FILE or more:
#
#   -t svg|png|pdf     form of the picture on standard output (svg)
#   -K K -R R -m M     shape factor, radius [m] and mass [kg] of the body: one number, or one for each
#                      run, 0.5,0.83; K and R may have an uncertainty, 0.5+-0.005
#   -c x|v             draw the positions (x) or the velocities (v); if a file has both, x
#   --use NAME=COLUMN  use this column as t, x or v; may be repeated
#   --run N            use only this run of the files
#   --law LAW          fit this law of fitpower(1), as d0+d2*v^2
set -euo pipefail
export LC_ALL=C
unset CDPATH
also=${BASH_SOURCE[0]}
figures=$(cd "$(dirname "$also")" && pwd)
samples=${figures%/*}
. "$samples/script.sh"
# A script that sources this has said in `takes` which options it has too, and in
# `needs` what has to be said of a body. Its operands are in `files`.
t=svg slope=${slope-0} at='' count=1
default_slope=$slope
options "-t -K -R -m -c --use... --run --law ${takes-}" "$@"
files=(${operands[@]+"${operands[@]}"}) own=${#operands[@]} form=$t column=$c
of_own=$(printf '%s\n' $chosen | grep -vxe -t -e --at | tail -n 1) || true
case $form in svg | png | pdf) ;; *) wrong "-t $form: svg, png or pdf" ;; esac
case $column in '' | x | v) ;; *) wrong "-c $column: x or v" ;; esac
is_number "$slope" || [ "$slope" = "$default_slope" ] ||
  wrong "--slope $slope: a number, which fitpower --slope fit finds"
[ -z "$at" ] || is_number "$at" || wrong "$at is not a time in seconds"
[ $own -gt 0 ] || [ -z "$of_own" ] || wrong "$of_own is for a run of your own: name its FILE"
command -v gnuplot >/dev/null || wrong 'gnuplot is not installed; make setup figures installs it'
make_scratch
cp "$figures"/*.gp "${scratch:?}"

# prepare SAMPLE...: reads the FILEs, or these samples, and goes to the folder of this run. There
# `readings` has the runs, roll1 the free roll of the first, and so on up to roll$count, and `names`
# their names. What the tools say of runs of your own reaches the user.
prepare() {
  local i name file
  quiet='' route=''
  if [ $own = 0 ]; then
    quiet=1
    for name; do
      files+=("$samples/$name.csv")
      K+=${K:+,}$(value shape-factor "$samples/$name.toml")
      R+=${R:+,}$(value radius "$samples/$name.toml")
      m+=${m:+,}$(value mass "$samples/$name.toml")
    done
  fi
  needs=${needs--K 0.5 -R 0.04}
  for i in K R m; do
    case $needs in *-$i*) [ "${!i}" ] || wrong "say what rolled: $needs" ;; esac
  done
  name=${files[0]##*/}
  # What can be read but once is copied: it is read more than once here.
  for i in "${!files[@]}"; do
    file=${files[i]}
    if [ "$file" = - ] || [ -p "$file" ] || [ -c "$file" ]; then
      cat -- "$file" >"$scratch/operand$i"
      files[i]=$scratch/operand$i
    fi
  done
  if [ "$column" != v ] && take x >"$scratch/readings"; then column=x route=position
  elif [ -z "$column" ] && ! grep -q "no column 'x'" "$scratch/said"; then :  # it says what is wrong
  elif [ "$column" != x ] && take v >"$scratch/readings"; then column=v route=velocity
  fi
  cat "$scratch/said" >&2
  [ "$route" ] || exit 2
  cd "$scratch"
  if ! grep -q '^## run ' readings; then
    { printf '## run %s\n' "${name//[[:cntrl:]]/?}" && cat readings; } >named
    mv named readings
  fi
  smooth ${quiet:+-q} --coast -c $column readings >rolls
  separate rolls roll
  # Of long names what all have in common is left out, in whole words.
  sed -n 's/^## run //p' rolls | sed 's/\.[cCtT][sSxX][vVtT]\( [^ ]*\)\{0,1\}$/\1/' | awk '
    function begins(text, n) { return substr(text, 1, n) }
    function ends(text, n) { return substr(text, length(text) - n + 1) }
    { name[NR] = $0; if (length($0) > 24) long = 1 }
    END {
      first = last = long && NR > 1 ? length(name[1]) : 0
      for (i = 2; i <= NR; i++) {
        while (begins(name[i], first) != begins(name[1], first)) first--
        while (ends(name[i], last) != ends(name[1], last)) last--
      }
      while (first && substr(name[1], first, 1) !~ /[ _.-]/) first--
      while (last && substr(name[1], length(name[1]) - last + 1, 1) !~ /[ _.-]/) last--
      for (i = 1; i <= NR; i++) {
        rest = length(name[i]) - first - last
        print (rest > 0 ? (first ? "…" : "") substr(name[i], first + 1, rest) (last ? "…" : "") : name[i])
      }
    }' >names
  count=$(($(wc -l <names)))
}
# separate FILE NAME: its runs as NAME1, NAME2 and so on.
separate() {
  awk -v name="$2" 'BEGIN { file = name (n = 1) } /^$/ { close(file); file = name (++n); next } { print >file }' "$1"
}
take() {
  smooth ${quiet:+-q} -w 1 -c "$1" ${use[@]+"${use[@]/#/--use=}"} ${run:+--run "$run"} -- "${files[@]}" \
    2>"$scratch/said"
}
one_run() { [ "$count" = 1 ] || wrong "this figure is of one run, not of $count: choose it with --run"; }

# What rolled in run number $1, as options.
body() {
  body=(-K "$(of_run "$K" "$1")" -R "$(of_run "$R" "$1")")
  [ "$slope" = fit ] || body+=("--slope=$slope")  # else it is in the row of the fit
}
# fit FILE: the law of each run in it as fit1, fit2 and so on.
fit() {
  fitpower ${quiet:+-q} --each -K "$K" -R "$R" "--slope=$slope" ${law:+--law "$law"} "$@" >fits
  awk '/^##/ { next } /^#/ { names = $0; next } { file = "fit" (++n); print names "\n" $0 >file; close(file) }' fits
}
# The energies of one run: `measured`, by velocities that are the slopes of parabolas, and `fitted`, with
# t, E_trans, E_rot, E_diss, W_g, v; $parts of the four energies count, from $start on.
balance() {
  one_run
  fit --route $route rolls
  body 1
  if [ $column = x ]; then differentiate -q -c x -M savgol -w "$(window "$seconds" roll1 3)" roll1
  else smooth -q -c v -M savgol -w "$(window "$seconds" roll1 3)" roll1; fi >moving
  simulate ${quiet:+-q} --law fit1 "${body[@]}" --at roll1 --columns t,v >rolling
  for motion in moving:measured rolling:fitted; do
    energy-ledger ${quiet:+-q} -m "$m" --law fit1 "${body[@]}" --columns E_trans,E_rot,E_diss,W_g "${motion%:*}" |
      columns - t E_trans E_rot E_diss W_g v >"${motion#*:}"
  done
  start=$(columns roll1 t | sed -n 1p) parts=4
  [ "$slope" != 0 ] || parts=3
}
# The law of the row $1 for people: a = 1.872 ± 0.022 mm, b = 0.217 ± 0.007.
law_of() {
  awk -F '\t' '
    /^#/ { sub(/^# /, ""); split($0, name); next }
    { for (i = 1; i < NF; i++) {
        unit = name[i]
        sub(/\[.*/, "", name[i])
        if (name[i] ~ /^(corr.*|rms)$/) break
        if (name[i] ~ /^sigma_/ || name[i + 1] !~ "^sigma_") continue
        unit = unit ~ /\[/ ? substr(unit, length(name[i]) + 2) : ""
        sub(/\]$/, "", unit)
        size = unit == "m" ? 1000 : 1
        digits = 3
        while (digits < 9 && $(i + 1) > 0 && size * $(i + 1) * 10^digits < 1) digits++
        number = digits > 6 ? "%.4g ± %.2g%s" : "%." digits "f ± %." digits "f%s"
        printf "%s%s = " number, (text++ ? ",  " : ""), name[i], size * $i,
          size * $(i + 1), (unit == "" ? "" : size == 1 ? " " unit : " mm")
      } }
    END { print "" }' "$1"
}
# The rows of a smoothed run whose windows are whole: those near its ends are means over fewer rows,
# and noisier. Of a run that is shorter than two windows all rows.
whole_windows() {
  awk -F '\t' -v width="$seconds" '
    /^##/ { print; next }
    /^#/ { print; sub(/^# /, ""); for (i = 1; i <= NF; i++) if ($i ~ /^t\[/) t = i; next }
    { row[++n] = $0; time[n] = $t }
    END {
      margin = time[n] - time[1] > 2 * width ? 0.499 * width : 0
      for (i = 1; i <= n; i++)
        if (time[i] - time[1] >= margin && time[n] - time[i] >= margin) print row[i]
    }'
}

# draw WIDTH HEIGHT [ASSIGNMENTS]: gnuplot on the commands of standard input, after style.gp and
# runs.gp. $title is the title of the SVG, which readers for the blind and browsers tell. A PNG has 240
# dots an inch where the SVG has 96. The symbols of the terminals are made alike: those of svg are thin,
# those of cairo small.
draw() {
  local terminal=svg size=$1,$2
  cd "$scratch"
  case $form in
    png)
      terminal=pngcairo
      size="$(($1 * 5 / 2)),$(($2 * 5 / 2)) fontscale 1.95 linewidth 2.5 pointscale 3.2" ;;
    pdf)
      terminal=pdfcairo
      size="$(awk "BEGIN { print $1 / 96 \"in,\" $2 / 96 \"in\" }") fontscale 0.58 linewidth 1.6" ;;
  esac
  LC_ALL=C.UTF-8 gnuplot -d \
    -e "set terminal $terminal size $size font 'sans-serif,14' background 'white'" \
    -e "own = $own; count = $count; ${3:-}" style.gp runs.gp /dev/stdin |
    if [ "$form" = svg ]; then
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

# instant T COLUMNS: the roll at one instant, in exact geometry, as assignments in `now`, with what
# energy-ledger computes: of a run of your own at --at, or else where its free roll begins; of the
# scene CR at --at or T. A roll towards falling x is mirrored.
instant() {
  name='The cylinder on rubber'
  if [ $own = 0 ]; then
    at=${at:-$1}
    K=$(value shape-factor "$samples/CR.toml") R=$(value radius "$samples/CR.toml")
    m=$(value mass "$samples/CR.toml")
    printf 't\n%s\n' "$at" | simulate --scene "$samples/CR.toml" --exact --at - >"$scratch/row"
  else
    prepare
    one_run
    fit --exact --route $route rolls
    at=${at:-$(columns fit1 t0)} name=$(cat names)
    printf 't\n%s\n' "$at" | simulate --law fit1 -K "$K" -R "$R" --exact --at - >row
  fi
  now="K = ${K%%+-*}; R = ${R%%+-*}; m = $m; $(awk -F '\t' -v OFS='\t' '
      /^#/ || $3 !~ /^-/ { print; next }
      { for (i = 2; i <= NF; i++) if (!sub(/^-/, "", $i)) $i = "-" $i; print }' "$scratch/row" |
    energy-ledger -m "$m" -K "$K" -R "$R" --exact --temperature 293 --columns "$2" | assignments)"
  case $now in *' v = 0; '*) wrong "at t = $at s the body is at rest" ;; esac
  printf '%s\n' "$name" >"$scratch/name"
}
