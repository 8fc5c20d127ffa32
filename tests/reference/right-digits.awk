# SPDX-License-Identifier: GPL-3.0-or-later
# How many digits of a certified fit a row of fitpower has: awk -f right-digits.awk ROW FILE.dat
# The exit status is 1 if a number has fewer than it should: 11, or 15.5 less those that the condition
# of the record costs, if that is less. With -v table=1 it prints the digits of each number.

function digits(x, y) {
  if (x == y)
    return 16
  if (y == 0 || x / y <= 0)
    return 0
  return -log(x > y ? (x - y) / y : (y - x) / y) / log(10)
}
function ask(what, x, y, lost,   right, least) {
  if (y < 0) {
    x = -x
    y = -y
  }
  right = digits(x, y)
  least = 15.5 - lost < 11 ? 15.5 - lost : 11
  if (!(right >= least)) {
    printf "%s: %s is %.17g, certified %.17g: %.1f digits, not %.1f\n", name, what, x, y, right, least
    bad = 1
  }
  if (asked == 0 || right < worst)
    worst = right
  asked++
  all = all sprintf("  %s %.1f", what, right)
}

# The row.
FNR == NR && /^# / {
  sub(/^# /, "")
  columns = split($0, column, "\t")
  for (i = 1; i <= columns; i++)
    sub(/\[.*/, "", column[i])
}
FNR == NR && /^[0-9-]/ {
  for (i = 1; i <= columns; i++)
    row[column[i]] = $i
}
FNR == NR { next }

# The certified values.
/^Dataset Name:/ { name = $3 }
/^Parameters:/ {
  gsub(/,/, "")
  for (i = 2; i <= NF; i++)
    parameter[i - 1] = $i
}
/^ *b[0-9]+ =/ {
  k++
  value[k] = $5
  deviation[k] = $6
}
/^Residual Standard Deviation:/ { rms = $4 }
/^Condition/ {
  for (i = 1; i <= k; i++) {
    lost[i] = log($(4 + i)) / log(10)
    most = lost[i] > most ? lost[i] : most
  }
}
/^Data:   y/ { exit }
END {
  for (i = 1; i <= k; i++) {
    if (!(parameter[i] in row))  # v0 and x0 of one of several runs are no columns
      continue
    ask(parameter[i], row[parameter[i]], value[i], lost[i])
    ask("sigma_" parameter[i], row["sigma_" parameter[i]], deviation[i], most)
  }
  ask("rms", row["rms"], rms, 0)
  if (asked < 5) {
    print name ": only " asked " numbers were compared"
    bad = 1
  }
  if (table)
    printf "%-10s %5.1f%s\n", name, worst, all
  exit bad
}
