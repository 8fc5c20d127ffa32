# SPDX-License-Identifier: GPL-3.0-or-later
# awk -f pulls.awk truth.txt table.txt: (found - true)/error of a and of b over the runs, their
# mean (0) and their standard deviation (1). The status is 1 if either is further off than four of
# its standard errors and 0.2: fits of such short runs may be biased by as much.
BEGIN { FS = "\t" }
/^#/ { next }
FILENAME == ARGV[1] { a[$1] = $2; b[$1] = $3; next }
{ run = $NF; sub(/\.csv$/, "", run) }
!(run in a) { print run " is not in " ARGV[1] >"/dev/stderr"; wrong = 1; exit }
{ add("a", ($1 - a[run]) / $2); add("b", ($3 - b[run]) / $4); ++n }
function add(what, pull) { sum[what] += pull; squares[what] += pull ^ 2 }
END {
  if (n < 2 || wrong) exit 2
  for (i = 1; i <= 2; ++i) {
    what = substr("ab", i, 1)
    mean = sum[what] / n; sd = sqrt((squares[what] - n * mean ^ 2) / (n - 1))
    printf "%s  %d pulls: mean %+.2f +- %.2f, standard deviation %.2f +- %.2f\n", what, n, mean,
      1 / sqrt(n), sd, 1 / sqrt(2 * n)
    if (mean ^ 2 > (0.2 + 4 / sqrt(n)) ^ 2 || (sd - 1) ^ 2 > (0.2 + 4 / sqrt(2 * n)) ^ 2) wrong = 1
  }
  exit wrong
}
