# SPDX-License-Identifier: GPL-3.0-or-later
# awk -f told.awk: of lines that fit.sh tells of many runs, those that differ in the name of the run
# and in numbers alone become one, the first, which says how many more there were.
{
  kind = $0
  if (match($0, /: (smooth|fitpower): /)) {
    name = substr($0, 1, RSTART - 1)
    kind = substr($0, RSTART)
    while ((at = index(kind, name)) > 0)
      kind = substr(kind, 1, at - 1) substr(kind, at + length(name))
  }
  gsub(/[-+]?[0-9.][-+0-9.e]*/, "0", kind)
  gsub(/rows? /, "row ", kind)
  if (!count[kind]++) { first[++kinds] = $0; key[kinds] = kind }
}
END {
  for (i = 1; i <= kinds; i++) {
    more = count[key[i]] - 1
    print first[i] (more ? "; and " more " more like it" : "")
  }
}
