# SPDX-License-Identifier: GPL-3.0-or-later
# Makes CITATION.cff of the entries of a BibTeX file, one field a line or over several:
#   awk -f citation.awk samples/rolling.bib

/^@/ {
  kind[++count] = substr($0, 2, index($0, "{") - 2)
  next
}
/^ / {
  if (/^  [a-z]+ *= \{/) {
    name = $1
    sub(/^[^{]*\{/, "")
  }
  sub(/^ +/, "")
  sub(/\},$/, "")
  field[count, name] = field[count, name] (field[count, name] == "" ? "" : " ") $0
}

function line(i, bib, cff, indent) {
  if ((i, bib) in field) print indent cff ": \"" field[i, bib] "\""
}
function entry(i, indent,   n, k, person, parts) {
  line(i, "title", "title", indent)
  line(i, "version", "version", indent)
  line(i, "license", "license", indent)
  line(i, "journal", "journal", indent)
  line(i, "volume", "volume", indent)
  line(i, "pages", "start", indent)
  line(i, "year", "year", indent)
  line(i, "doi", "doi", indent)
  line(i, "note", "notes", indent)
  print indent "authors:"
  n = split(field[i, "author"], person, " and ")
  for (k = 1; k <= n; ++k) {
    gsub(/[{}]/, "", person[k])
    if (split(person[k], parts, ", ") == 2) {
      print indent "  - family-names: \"" parts[1] "\""
      print indent "    given-names: \"" parts[2] "\""
    } else print indent "  - name: \"" person[k] "\""
  }
}
END {
  print "cff-version: 1.2.0"
  print "message: \"If you use this software, cite it and the paper that it reproduces.\""
  print "type: software"
  for (i = 1; i <= count; ++i) if (kind[i] == "software") entry(i, "")
  print "references:"
  for (i = 1; i <= count; ++i) if (kind[i] != "software") {
    print "  - type: " (kind[i] == "article" ? "article" : "generic")
    entry(i, "    ")
  }
}
