# SPDX-License-Identifier: GPL-3.0-or-later
# A random file of runs into `file`, and what a reader must find behind `chain` into `expected`; see
# ../round-trip.sh. Variables: seed, runs, extra (the names of the columns that the chain appends),
# history (its `##` lines, without marks), each separated by |.
function random(n) { return int(n * rand()) }
function one_of(list,   parts) { return parts[1 + random(split(list, parts, "|"))] }
function shown(text) { gsub(/\\/, "\\\\", text); gsub(/\t/, "\\t", text); gsub(/\n/, "\\n", text); return text }
function remark(   n, text) {
  for (n = 1 + random(5); n; n--) text = text " " one_of("made|on|Tuesday|#|\"q|5\"|q,b|c;d|--|caf\303\251")
  return text one_of("|\te")
}
function word(   n, text) {
  for (n = random(5); n; n--) text = text one_of(blanks ? "a|B|z|-|'|_|\"|#|=" : "a|B|z|-|'|_|\"|#| |\t|,|;|\n|\"\"")
  gsub(/^[ \t]+|[ \t]+$/, "", text)
  if (blanks) gsub(/^["#]+|^$/, "w", text)
  return text
}
function cell(text) {  # as it stands in the file
  if (blanks) return text
  if (text ~ /["\t\n,;]/ || text ~ /^#/ || random(8) == 0) { gsub(/"/, "\"\"", text); return "\"" text "\"" }
  return text
}
function number(   form) {
  form = random(5)
  if (form == 0) return random(1000) "." random(1000) + 1000
  if (form == 1) return "-" random(9) + 1 "e-" random(20)
  if (form == 2) return sprintf("%.17g", rand())
  if (form == 3) return "+0" random(100) ".50"
  return random(1000) ""
}
function columns(   i, j, swap) {  # of the runs from here on
  width = 3 + random(3)
  name[1] = "t"; name[2] = "v"; name[3] = one_of("note|Wheel Speed|n1"); name[4] = "u"; name[5] = "p_q"
  unit[1] = one_of("|s|ms"); unit[2] = one_of("|m/s|km/h"); unit[3] = one_of("|rpm|%"); unit[4] = one_of("|V"); unit[5] = ""
  kind[1] = "t"; kind[2] = "v"; kind[3] = "text"; kind[4] = "text"; kind[5] = "number"
  for (i = 1; i <= width; i++) {
    j = i + random(width - i + 1)
    swap = name[i]; name[i] = name[j]; name[j] = swap
    swap = unit[i]; unit[i] = unit[j]; unit[j] = swap
    swap = kind[i]; kind[i] = kind[j]; kind[j] = swap
  }
}
function named(i, style) {
  if (unit[i] == "") return name[i]
  return name[i] (style ? " (" unit[i] ")" : "[" unit[i] "]")
}
function names_line(   i, between, text, mark, style) {
  mark = random(2) ? "# " : ""
  style = random(2)
  between = mark == "" ? (blanks ? " " : separator) : one_of("\t|\t|, ")
  for (i = 1; i <= width; i++) {
    if (blanks || between == ", ") gsub(/ /, "_", name[i])
    text = text (i > 1 ? between : "") (mark == "" && !blanks ? cell(named(i, style)) : named(i, style))
  }
  if (ended && between != ", ") text = text between
  return mark text
}
function tell_columns(   i, text, plain, all) {
  for (i = 1; i <= width; i++) {
    plain = name[i]
    gsub(/ /, "_", plain)
    text = kind[i] == "t" ? "s" : kind[i] == "v" ? "m/s" : unit[i]
    all = all "COL " plain (text == "" ? "" : "[" text "]") "\n"
  }
  return all
}
BEGIN {
  srand(seed)
  separator = one_of("\t|;|,| ")
  blanks = separator == " "
  ended = !blanks && random(4) == 0
  added = split(extra, appended, "|")
  for (r = 1; r <= runs; r++) {
    # The head.
    head = rem = his = ""
    fresh = r == 1 || random(3) == 0
    if (fresh) columns()
    own = random(2)
    if (random(3) == 0) { run = "r " r; head = "## run " run "\n"; told = "RUN " run "\n" } else told = ""
    if (random(2)) { text = remark(); head = head "#" text "\n"; rem = rem "REM #" shown(text) "\n" }
    for (i = 0; own && i <= random(3); i++) { text = "by hand " r " " i; head = head "## " text "\n"; his = his "HIS " text "\n" }
    if (fresh) head = head names_line() "\n"
    if (random(3) == 0) {
      text = remark()
      head = head "#" text "\n"
      rem = rem "REM #" shown(text) "\n"
    }
    m = split(history, lines, "|")
    for (i = 1; i <= m; i++) his = his "HIS " lines[i] "\n"
    if (r > 1 && !(head ~ /^##/ && random(2))) printf "%s", one_of("\n|\n\n \n") >file
    printf "%s", head >file
    printf "%s%s%s%s", told, rem, his, tell_columns() >expected
    for (i = 1; i <= added; i++) print "COL " appended[i] >expected
    # The rows.
    rows = 2 + random(4)
    for (k = 0; k < rows; k++) {
      row = out = ""
      missing = k > 1 && random(6) == 0
      for (i = 1; i <= width; i++) {
        text = kind[i] == "t" ? (40 * k) "" : kind[i] == "v" ? (missing ? (blanks || random(2) ? "NaN" : "") : unit[i] == "km/h" ? 18 * random(50) "" : number()) : kind[i] == "number" ? number() : word()
        row = row (i > 1 ? separator : "") cell(text)
        if (kind[i] == "t" && unit[i] == "ms") text = sprintf("%.15g", text / 1000)
        if (kind[i] == "v" && unit[i] == "km/h") text = text * 5 / 18
        out = out (i > 1 ? "|" : "") shown(text)
      }
      if (ended) row = row separator
      if (k && random(6) == 0) { text = remark(); printf "#%s\n", text >file; print "REM #" shown(text) >expected }
      print row >file
      if (!missing) print "ROW " out >expected
    }
    if (random(6) == 0) { text = remark(); printf "#%s\n", text >file; print "REM #" shown(text) >expected }
  }
}
