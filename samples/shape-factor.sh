#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures the shape factor K = J / (m R^2) of a body (the paper's note 23). The body turns about a
# fixed axis, and a sensor reads its angle. In the run FALL a weight on a thread drives the body; in the
# run SPIN it spins down freely without the weight, which gives the friction of the bearing.
#
#   shape-factor.sh -m M -R R -r r -w W [-g G] FALL SPIN   prints K, for -K: 0.4991+-0.0018
#   shape-factor.sh make FOLDER SEED                       makes such runs, with a known answer
#   shape-factor.sh                                        makes runs of cylinder and shell, and uses
#                                                          their K
#
#   -m M   mass of the body [kg]; all values may have a standard uncertainty: 1.375+-0.001
#   -R R   its radius [m]
#   -r r   radius at which the thread is wound [m]
#   -w W   mass of the weight [kg]
#   -g G   gravity (9.81 m/s^2)
#
# A run has the columns Time (s) and Angle (rad), or Angle (deg), in any form of rolling-columns(5). FALL
# begins after the weight is released and ends before it lands.
set -euo pipefail
export LC_ALL=C
unset CDPATH
. "$(dirname "$0")/script.sh"
here=$(cd "$(dirname "$0")" && pwd)
# What was measured on the body of the runs that are made here.
made='-m 1.375+-0.001 -R 0.0400+-0.00005 -r 0.0100+-0.00002 -w 0.0500+-0.00005'
# shellcheck disable=SC2034  # numbers() takes it by its name
g=9.81
options '-m -R -r -w -g' "$@"
set -- ${operands[@]+"${operands[@]}"}
for option in $chosen; do
  given=${option#-}
  for number in "${!given%%+-*}" "${!given#*+-}"; do
    is_number "${number:-x}" || wrong "$option ${!given}: a number, or one like 1.375+-0.001"
  done
done
[ $# -gt 0 ] || [ -z "$m$R$r$w" ] || wrong 'these values are for your own runs: name FALL and SPIN'

# The run as smooth reads it, in seconds and radians. The angle stands for a position: the arc of a
# circle of 1 m. A film of the fall run backwards slows down.
arc() {  # FILE forwards|backwards
  smooth -c Angle -w 1 -- "$1" | awk -F '\t' -v way="$2" '
    function refuse(why) { print "shape-factor.sh: " why >"/dev/stderr"; wrong = 2; exit wrong }
    # The column of this name, and its unit.
    function place(name,   i) {
      for (i = 1; i <= fields; i++) if (head[i] ~ "^" name "(\\[|$)") break
      unit = substr(head[i], length(name) + 2)
      sub(/\]$/, "", unit)
      return i
    }
    /^##/ { next }
    /^#/ { fields = split(substr($0, 3), head); next }
    /^$/ { refuse("two runs in a file: smooth --run N picks one") }
    !n {
      time = place("t"); column = place("Angle")
      if (unit == "deg" || unit == "°") size = atan2(0, -1) / 180
      else if (unit == "rad") size = 1
      else refuse(unit == "" ? "Angle has no unit" : "Angle is in \047" unit "\047, not in rad or deg")
    }
    { t[++n] = $time; angle[n] = size * $column }
    END {
      if (wrong) exit wrong
      print "# t[s]\tx[m]"
      for (i = 1; i <= n; i++)
        if (way == "forwards") printf "%.17g\t%.17g\n", t[i], angle[i]
        else printf "%.17g\t%.17g\n", t[n] - t[n + 1 - i], angle[n] - angle[n + 1 - i]
    }'
}

# The angular acceleration in a run from rest or to rest: `a sigma_a`, in rad/s^2 / 1000.
# A constant deceleration is the motion of Eq. 12 with b = 0: v' = -g a / ((K + 1) R), so that
# fitpower finds it, with its error; K = 0, R = 1 m and g = 1000 m/s^2 make it 1000 a.
acceleration() {  # FILE forwards|backwards
  local arc row
  arc=$(arc "$1" "$2") && row=$(fitpower -q --route position --fix b=0 -K 0 -R 1 -g 1000 <<<"$arc") ||
    { echo "shape-factor.sh: no acceleration from ${1##*/}" >&2; return 2; }
  tail -n 1 <<<"$row" | cut -f 1,2
}

# For awk: m, R, r, w, g and their standard uncertainties u_m, u_R, ... as assignments.
numbers() {
  local name
  for name in m R r w g; do
    case ${!name} in
      *+-*) printf '%s = %s; u_%s = %s\n' $name "${!name%%+-*}" $name "${!name#*+-}" ;;
      *) printf '%s = %s; u_%s = 0\n' $name "${!name}" $name ;;
    esac
  done
}

# The weight pulls with w (g - r alpha) at the radius r, against the friction J beta of the bearing:
#   J = w (g - r alpha) r / (alpha + beta)
# The uncertainties add in squares, each by the change of K that it makes.
shape_factor() {  # FALL SPIN
  local alpha beta
  alpha=$(acceleration "$1" backwards) && beta=$(acceleration "$2" forwards) || return
  printf '%s\n' "$alpha" "$beta" | awk '
    function K(m, R, r, w, g, alpha, beta) { return w * (g - r * alpha) * r / (alpha + beta) / (m * R^2) }
    function add(change) { sum += change^2 }
    NR == 1 { alpha = 1000 * $1; u_alpha = 1000 * $2 }
    NR == 2 { beta = 1000 * $1; u_beta = 1000 * $2 }
    END {
      '"$(numbers)"'
      k = K(m, R, r, w, g, alpha, beta)
      if (!(k > 0)) {
        print "shape-factor.sh: K would be " k ": the units, or what was measured, are not right" \
          >"/dev/stderr"
        exit 2
      }
      add(K(m + u_m, R, r, w, g, alpha, beta) - k)
      add(K(m, R + u_R, r, w, g, alpha, beta) - k)
      add(K(m, R, r + u_r, w, g, alpha, beta) - k)
      add(K(m, R, r, w + u_w, g, alpha, beta) - k)
      add(K(m, R, r, w, g + u_g, alpha, beta) - k)
      add(K(m, R, r, w, g, alpha + u_alpha, beta) - k)
      add(K(m, R, r, w, g, alpha, beta + u_beta) - k)
      printf "%.4f+-%.4f\n", k, sqrt(sum)
    }'
}

# Runs with a known answer: K = 0.50 and 0.83, a friction of 0.3 mN m, 25 rows a second of a
# wheel with 4000 marks that shakes by 1 mrad. The true mass, radii and weight are off the measured
# ones, each by a draw from its uncertainty, as they are for whoever measures.
make_runs() {  # FOLDER SEED
  local body K
  for body in cylinder:0.50 shell:0.83; do
    K=${body#*:}
    awk -v K="$K" -v seed="$2" -v file="$1/${body%:*}" "$random"'
      function round(x) { return x < 0 ? -int(0.5 - x) : int(x + 0.5) }
      function run(name, start, speed, acceleration, end,   i, t, mark) {
        mark = 6.283185307179586 / 4000
        name = file name
        print "Time (s),Angle (rad)" >name
        for (i = 0; i / 25 <= end; i++) {
          t = i / 25
          printf "%.2f,%.5f\n", t, \
            mark * round((start + speed * t + acceleration * t^2 / 2 + 0.001 * normal()) / mark) >name
        }
        close(name)
      }
      BEGIN {
        '"$(numbers)"'
        burn = 20 + seed * 37 % 101; seed = seed * 1000 + int(100 * K)
        for (i = 0; i < burn; i++) uniform()
        m += u_m * normal(); R += u_R * normal(); r += u_r * normal(); w += u_w * normal()
        J = K * m * R^2; friction = 3e-4
        alpha = (w * g * r - friction) / (J + w * r^2)
        run("-fall.csv", 0.4, 0.3, alpha, 6)
        run("-spin.csv", 1.1, 10, -friction / J, 15)
      }'
  done
}

case $#:${1-} in
  3:make)
    # shellcheck disable=SC2086  # options
    options '-m -R -r -w -g' $made
    [ -d "$2" ] || wrong "$2 is no folder"
    is_count "$3" || wrong "SEED is a whole number, not $3"
    make_scratch
    make_runs "$scratch" "$3"
    place "$2" "$scratch"/*
    ;;
  2:*)
    [ "$m" ] && [ "$R" ] && [ "$r" ] && [ "$w" ] || wrong "say what was measured: $made"
    shape_factor "$1" "$2"
    ;;
  0:)
    # shellcheck disable=SC2086
    options '-m -R -r -w -g' $made
    make_scratch
    make_runs "$scratch" 1
    echo "Shape factors from made runs, and the law of the rubber mat with them"
    for body in "cylinder 0.50 CR" "shell 0.83 SR"; do
      read -r name true sample <<<"$body"
      K=$(shape_factor "$scratch/$name-fall.csv" "$scratch/$name-spin.csv")
      printf '%s: K = %s (made with %s)\n' "$name" "$K" "$true"
      smooth -q --coast -c x -w 1 "$here/$sample.csv" |
        fitpower -q --route position -K "$K" -R 0.04 --digits 4
    done
    ;;
  *) wrong 'two runs, FALL and SPIN, or: make FOLDER SEED' ;;
esac
