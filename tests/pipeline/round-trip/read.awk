# SPDX-License-Identifier: GPL-3.0-or-later
# What stands in a file that a tool has written: RUN, REM, HIS, COL and ROW lines, as make.awk tells
# them. Knows nothing of the tools but rolling-columns(5): tabs, quotes, heads. `extra` is how many
# columns at the end are left out of the rows, which must all have as many fields as there are names.
function shown(text) { gsub(/\\/, "\\\\", text); gsub(/\t/, "\\t", text); gsub(/\n/, "\\n", text); return text }
function fields(line,   n, c, i, quoted, begins, text) {  # into field[]; 0 if the line ends within quotes
  n = 1; text = ""; quoted = 0; begins = 1
  for (i = 1; i <= length(line); i++) {
    c = substr(line, i, 1)
    if (quoted && c == "\"" && substr(line, i + 1, 1) == "\"") { text = text c; i++ }
    else if (quoted && c == "\"") quoted = 0
    else if (quoted) text = text c
    else if (begins && c == "\"") quoted = 1
    else if (c == "\t") { field[n++] = text; text = ""; begins = 1; continue }
    else text = text c
    begins = 0
  }
  field[n] = text
  return quoted ? 0 : n
}
function tell_head(   i) {
  if (!in_head) return
  printf "%s%s%s", run, rem, his
  # The last remark is the names.
  n_names = split(names, name, "\t")
  for (i = 1; i <= n_names; i++) print "COL " name[i]
  in_head = 0
}
BEGIN { in_head = 1 }
pending != "" { $0 = pending "\n" $0; pending = "" }
/^$/ { in_head = 1; run = rem = his = names = ""; next }
/^## run / && in_head { run = "RUN " substr($0, 8) "\n"; next }
/^##/ { if (!in_head) { print "a history line among the rows: " $0; exit 1 } his = his "HIS " substr($0, 4) "\n"; next }
/^#/ {
  if (!in_head) { print "REM " shown($0); next }
  if (names != "") rem = rem "REM # " shown(names) "\n"
  names = substr($0, 3)
  if (substr($0, 2, 1) != " ") { print "no names line: " $0; exit 1 }
  next
}
{
  n = fields($0)
  if (!n) { pending = $0; next }
  tell_head()
  if (n != n_names) { print n " fields under " n_names " names: " $0; exit 1 }
  row = ""
  for (i = 1; i <= n - extra; i++) row = row (i > 1 ? "|" : "") shown(field[i])
  print "ROW " row
}
END { if (pending != "") { print "a quote that is not closed: " pending; exit 1 } }
