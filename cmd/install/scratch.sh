# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=sh
# own scratch|new FOLDER: makes this folder, which becomes $scratch or $new; it fails if something is there.
# At the end of the script, by a signal too, both are removed, and nothing else. A second signal may come
# before it is ignored, and ends the function: each call removes the whole.
scratch='' new=''
remove_own() { rm -rf ${scratch:+"$scratch"} ${new:+"$new"}; }
end_by_signal() {
  trap '' INT TERM HUP
  remove_own
  exit 130
}
own() {
  trap '' INT TERM HUP  # not before the folder has its name
  mkdir "$2"
  eval "$1=\$2"
  trap remove_own EXIT
  trap end_by_signal INT TERM HUP
}
