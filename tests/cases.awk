# SPDX-License-Identifier: GPL-3.0-or-later
# Takes a file of cases apart for tests/run.sh, which says how one is written:
#   awk -v into=FOLDER -f cases.awk FILE.cases
# Case N goes into FOLDER/N.command, N.stdout, N.within, N.stderr and N.status, its files into the
# folder FOLDER/N, which is there; what stands above the first case goes into FOLDER itself. Prints
# for each case: N, its line in the file, its name.
function refuse(what) {
  print FILENAME ":" FNR ": " what >"/dev/stderr"
  refused = 1
  exit 2
}
function begin(path) {  # what follows goes into path
  if (path in seen) refuse("a second time in this case: " $0)
  seen[path] = 1
  if (target != "") close(target)
  target = path
  printf "" >target
}
function put(line) {
  if (target == "") refuse("nothing may stand here: " line)
  print line >target
}
function alone(path, line) {  # a file of one line
  begin(path)
  put(line)
  close(path)
  target = ""
}
function end_case() {
  if (!cases) return
  if (!commands) refuse("the case above has no command")
  if (!(of_case ".stdout" in seen) && !failing) refuse("the case above has no stdout")
}
# An empty line waits until it is known whether it is the one above a case.
function keep_empty_line() {
  if (empty) put("")
  empty = 0
}
/^=== / {
  if (cases && !empty) refuse("no empty line above a case")
  end_case()
  empty = commands = failing = 0
  name = substr($0, 5)
  if (name in names) refuse("a second case of this name")
  names[name]
  print ++cases, FNR, name
  of_case = into "/" cases
  begin(of_case ".command")
  in_command = 1
  next
}
/^--- / {
  keep_empty_line()
  in_command = 0
  what = substr($0, 5)
  if (what ~ /\//) refuse("not understood: " $0)
  else if (!cases) begin(into "/" what)
  else if (what == "stderr") begin(of_case ".stderr")
  else if (what ~ /^status [1-9][0-9]*$/) alone(of_case ".status", failing = substr(what, 8))
  else if (what ~ /^stdout( within [0-9.e+-]+( [0-9.e+-]+)?)?$/) {
    if (sub(/^stdout within /, "", what)) alone(of_case ".within", what)
    begin(of_case ".stdout")
  } else if (what ~ /^(stdout|stderr|status)/) refuse("not understood: " $0)
  else begin(of_case "/" what)
  next
}
target == "" && !cases && (/^#/ || /^$/) { next }
{
  keep_empty_line()
  if ($0 == "") {
    empty = 1
    next
  }
  commands += in_command && !/^#/
  put($0)
}
END {
  if (refused) exit 2
  keep_empty_line()
  end_case()
  exit refused ? 2 : 0
}
