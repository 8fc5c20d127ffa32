#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The shape factor comes back from made runs with the error that is told, over 5 seeds of two
# bodies (25 with LONG=1); a caliper that is read wrong is noticed; and what is printed serves as -K. A run is read
# as the tools read it.
set -u
export LC_ALL=C
unset CDPATH
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
samples/shape-factor.sh >"$scratch/out" || { echo "samples/shape-factor.sh fails"; exit 1; }
[ "$(grep -cE '^(cylinder|shell): K = 0\.[0-9]{4}\+-0\.00[0-9]{2} \(made with' "$scratch/out")" = 2 ] &&
  [ "$(grep -cE '^0\.001' "$scratch/out")" = 2 ] || { cat "$scratch/out"; exit 1; }

measured='-m 1.375+-0.001 -R 0.0400+-0.00005 -r 0.0100+-0.00002 -w 0.0500+-0.00005'

# The pulls, (K - true) / sigma, of the script $1.
pulls() {
  local seed body
  for seed in $(seq ${LONG:+2}5); do
    rm -f "$scratch"/*-fall.csv "$scratch"/*-spin.csv
    "$1" make "$scratch" "$seed"
    for body in cylinder:0.50 shell:0.83; do
      # shellcheck disable=SC2086  # options
      echo "$("$1" $measured "$scratch/${body%:*}-fall.csv" "$scratch/${body%:*}-spin.csv")" "${body#*:}"
    done
  done | sed 's/+-/ /' | awk '{ print ($1 - $3) / $2 }'
}
pulls samples/shape-factor.sh >"$scratch/pulls"
# The sum of 10 squares lies between 2.1 and 25.2 in 99 % of all cases, the mean within 0.81; of 50
# between 28 and 79, and 0.36.
awk -v seeds=$((10 * ${LONG:+2}5 / 5)) '{ sum += $1; squares += $1^2 }
  END { print NR, sum / NR, squares; exit !(NR == seeds && squares > (NR == 50 ? 28 : 2.1) && squares < (NR == 50 ? 79 : 25.2) && (sum / NR)^2 < 6.5 / NR) }' \
  "$scratch/pulls" >"$scratch/said" || { echo "pulls: $(cat "$scratch/said")"; exit 1; }

# A torque that is 2 % wrong; the runs are made with the right one.
cp samples/CR.csv samples/SR.csv samples/script.sh "$scratch"
sed '/^acceleration/,/^make_runs/ s/w \* (g - r \* alpha) \* r/w * (g - r * alpha) * 1.02 * r/' \
  samples/shape-factor.sh >"$scratch/wrong.sh"
cmp -s samples/shape-factor.sh "$scratch/wrong.sh" && { echo "nothing was changed"; exit 1; }
chmod +x "$scratch/wrong.sh"
pulls "$scratch/wrong.sh" | awk '{ squares += $1^2 } END { exit !(squares > 4 * NR) }' ||
  { echo "a radius that is wrong is not noticed"; exit 1; }

# Milliseconds and degrees are converted, in any place, with decimal commas too: the same K.
rm -f "$scratch"/*-fall.csv "$scratch"/*-spin.csv
samples/shape-factor.sh make "$scratch" 1
fall=$scratch/cylinder-fall.csv spin=$scratch/cylinder-spin.csv
# shellcheck disable=SC2086
of() { samples/shape-factor.sh $measured "$@"; }
K=$(of "$fall" "$spin")
wrong=0
complain() { echo "$*" && wrong=1; }
same() {  # TITLE AWK: both runs, changed by awk, tell the same K
  awk -F, -v OFS=, "$2" "$fall" >"$scratch/a.csv"
  awk -F, -v OFS=, "$2" "$spin" >"$scratch/b.csv"
  local said
  said=$(of "$scratch/a.csv" "$scratch/b.csv" 2>&1)
  [ "$said" = "$K" ] || complain "$1: $said, not $K"
}
same 'ms and degrees' 'NR == 1 { print "Time (ms),Angle (deg)"; next }
  { print 1000 * $1, sprintf("%.12g", $2 * 57.29577951308232) }'
same 'degrees of a sign' 'NR == 1 { print "Time (s),Angle (°)"; next }
  { print $1, sprintf("%.12g", $2 * 57.29577951308232) }'
same 'another column' 'NR == 1 { print "Angle (rad),Torque,Time (s)"; next } { print $2, 7, $1 }'
same 'decimal commas' '{ t = $1; angle = $2; gsub(/[.]/, ",", t); gsub(/[.]/, ",", angle); print t ";" angle }'
same 'comments' 'NR == 1 { print "# Sensor\t7\n## any [deg]\n# t\tAngle of mount [deg]\tAngle [rad]"; next }
  { print $1 "\t" 3 "\t" $2 }'
same 'BOM and CR' 'NR == 1 { printf "\357\273\277" } { print $0 "\r" }'

# Blank readings are left out, and told.
awk -F, -v OFS=, 'NR % 7 == 3 { $2 = "" } { print $1, $2 }' "$fall" >"$scratch/blank.csv"
said=$(of "$scratch/blank.csv" "$spin" 2>"$scratch/err")
awk -v K="$K" -v is="$said" 'BEGIN { split(K, k, /\+-/); n = split(is, i, /\+-/)
    exit !(n == 2 && (k[1] - i[1])^2 < k[2]^2 / 4) }' ||
  complain "with blank readings K is $said, not $K"
grep -q '22 rows left out: a reading is missing' "$scratch/err" ||
  complain "blank readings: $(cat "$scratch/err")"

# What cannot be read, or does not tell an acceleration, ends the script, and prints no K.
refused() {  # WHY FALL SPIN
  local said status
  said=$(of "$2" "$3" 2>"$scratch/err")
  status=$?
  [ $status -gt 0 ] && [ -z "$said" ] && grep -q -- "$1" "$scratch/err" ||
    complain "$1: status $status, $said, $(cat "$scratch/err")"
}
sed 's/(rad)/(rev)/' "$fall" >"$scratch/a.csv"
refused "Angle is in 'rev', not in rad or deg" "$scratch/a.csv" "$spin"
sed 's/ (rad)//' "$spin" >"$scratch/a.csv"
refused "Angle has no unit" "$fall" "$scratch/a.csv"
sed 1d "$fall" >"$scratch/a.csv"
refused "there is no column 'Angle'" "$scratch/a.csv" "$spin"
sed '9s/.*/0.28,abc/' "$spin" >"$scratch/a.csv"
refused "a.csv:9: field 2 (Angle): 'abc' is not a number" "$fall" "$scratch/a.csv"
refused 'nofile' "$scratch/nofile" "$spin"
head -n 3 "$spin" >"$scratch/a.csv"
refused 'fitpower: ' "$fall" "$scratch/a.csv"
{ cat "$fall"; echo; sed 1d "$fall"; } >"$scratch/a.csv"
refused 'two runs' "$scratch/a.csv" "$spin"
refused 'fitpower: ' "$spin" "$fall"
sed 's/(s)/(ms)/' "$fall" >"$scratch/a.csv"
refused 'K would be -' "$scratch/a.csv" "$spin"

# K goes as 1/(m R^2), and nearly as w r; another body has another K; what was measured is not guessed.
awk -v K="$K" -v other="$(samples/shape-factor.sh -m 2.75 -R 0.02 -r 0.01 -w 0.05 "$fall" "$spin")" 'BEGIN {
  split(K, k, /\+-/); split(other, o, /\+-/); exit !((o[1] / k[1] - 2)^2 < 1e-6 && o[2] / o[1] < k[2] / k[1]) }' ||
  complain "half the radius and twice the mass are not twice K"
awk -v K="$K" -v more="$(of -m 1.375+-0.1 "$fall" "$spin")" 'BEGIN {
  split(K, k, /\+-/); split(more, o, /\+-/); want = k[1] * 0.1 / 1.475
  exit !(o[1] == k[1] && (o[2] / want - 1)^2 < 1e-3) }' || complain "an uncertainty of the mass"
for missing in '-m 1.375' '-R 0.04' '-r 0.01' '-w 0.05'; do
  options=" $measured "
  options=$(sed "s/ ${missing% *} [^ ]*//" <<<"$options")
  # shellcheck disable=SC2086
  said=$(samples/shape-factor.sh $options "$fall" "$spin" 2>&1) && complain "without $missing: $said"
  [ "$said" = "shape-factor.sh: say what was measured: $measured" ] || complain "without $missing: $said"
done
said=$(samples/shape-factor.sh -m 1,375 "$fall" "$spin" 2>&1) && complain "-m 1,375: $said"
[ "$said" = 'shape-factor.sh: -m 1,375: a number, or one like 1.375+-0.001' ] || complain "-m 1,375: $said"
exit $wrong
