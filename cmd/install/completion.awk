# SPDX-License-Identifier: GPL-3.0-or-later
# The completion of a tool, made from its --help:
#   TOOL --help | awk -v shell=bash -v name=TOOL -f completion.awk
# shell is bash, zsh or fish. The type of an option says which values it has: {one,of,these}, a FILE, or
# what only the user knows.

/^Usage: / { operands = /FILE/ }
/^  -/ {  # "  -w,--width N                width of the window"
  line = substr($0, 3) "  "
  end = index(line, "  ")
  parts = split(substr(line, 1, end - 1), part, " ")
  names[++count] = part[1]
  type[count] = parts > 1 ? part[2] : ""
  repeats[count] = parts > 2  # ...
  help[count] = substr(line, end)
  gsub(/^ +| +$/, "", help[count])
}
count && /^          / {
  sub(/^ +/, "")
  help[count] = help[count] (help[count] == "" ? "" : " ") $0
}

# The values of {one,of,these}, separated by blanks.
function values(i, text) {
  text = type[i]
  if (gsub(/[{}]/, "", text) == 0) return ""
  gsub(/,/, " ", text)
  return text
}

function bash(    i, pattern, options, files, others, function_name) {
  function_name = "_rolling_" name
  gsub(/-/, "_", function_name)
  print "# bash completion of " name "(1), made from its --help"
  print function_name "() {"
  print "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words='' files=''"
  print "  if [[ $current == = ]]; then current=''  # bash takes --method=mean for three words"
  print "  elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}"
  print "  fi"
  print "  case $previous in"
  for (i = 1; i <= count; ++i) {
    options = options (i > 1 ? " " : "") names[i]
    pattern = names[i]
    sub(/,/, " | ", pattern)
    if (values(i) != "") print "    " pattern ") words='" values(i) "' ;;"
    else if (type[i] == "FILE") files = files (files == "" ? "" : " | ") pattern
    else if (type[i] != "") others = others (others == "" ? "" : " | ") pattern
  }
  gsub(/,/, " ", options)
  if (files != "") print "    " files ") files=yes ;;"
  print "    " others ") ;;"
  if (operands) print "    *) if [[ $current == -* ]]; then words='" options "'; else files=yes; fi ;;"
  else print "    *) words='" options "' ;;"
  print "  esac"
  print "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))  # words without a blank"
  print "  [[ $files ]] || compopt +o default 2>/dev/null  # which only a completion under way can do"
  print "}"
  print "complete -o default -F " function_name " " name "  # default: file names, where there are no words"
}

function zsh(    i, part, words, value) {
  print "#compdef " name
  print "# zsh completion of " name "(1), made from its --help"
  print "_arguments -s" (operands ? " '*:file:_files'" : "") " \\"
  for (i = 1; i <= count; ++i) {
    words = help[i]
    gsub(/[]:[\\]/, "\\\\&", words)
    gsub(/'/, "'\\''", words)
    if (values(i) != "") value = ":value:(" values(i) ")"
    else if (type[i] == "FILE") value = ":file:_files"
    else value = type[i] != "" ? ":" tolower(type[i]) ": " : ""
    words = "'[" words "]" value "'" (i < count ? " \\" : "")
    if (split(names[i], part, ",") == 2) {
      value = "{" part[1] (type[i] == "" ? "" : "+") "," part[2] (type[i] == "" ? "" : "=") "}"
      print "  '(" part[1] " " part[2] ")'" value words
    } else print "  " (repeats[i] ? "'*'" : "") part[1] (type[i] == "" ? "" : "=") words
  }
}

function fish(    i, part, words, last) {
  print "# fish completion of " name "(1), made from its --help"
  if (!operands) print "complete -c " name " -f"
  for (i = 1; i <= count; ++i) {
    last = split(names[i], part, ",")
    words = help[i]
    gsub(/[\\']/, "\\\\&", words)
    print "complete -c " name (last == 2 ? " -s " substr(part[1], 2) : "") " -l " substr(part[last], 3) \
      (type[i] == "" ? "" : type[i] == "FILE" ? " -r -F" : " -x") \
      (values(i) == "" ? "" : " -a '" values(i) "'") " -d '" words "'"
  }
}

END {
  if (shell == "zsh") zsh()
  else if (shell == "fish") fish()
  else bash()
}
