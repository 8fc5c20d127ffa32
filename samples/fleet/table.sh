#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# table.sh -K K -R R [-c x|v] FOLDER [OPTION-OF-parallel]...: one table of the fits of all runs in
# FOLDER, by GNU parallel: as many at a time as there are processors, or as the options say. What is told
# of several runs is one line on standard error. On other machines too, if they have the tools on
# their PATH:
#   samples/fleet/table.sh -K 0.5 -R 0.04 run --sshlogin 8/ann,8/ben,: --transferfile {} \
#     --basefile samples/fleet/fit.sh --cleanup
set -euo pipefail
export LC_ALL=C
unset CDPATH
here=$(dirname "$0")
body=()
while getopts K:R:c: option; do
  case $option in
    K | R | c) body+=("-$option" "$OPTARG") ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] && [ ${#body[@]} -ge 4 ] ||
  { echo "table.sh: say what rolled, and the folder: table.sh -K 0.5 -R 0.04 FOLDER [OPTION]..." >&2; exit 2; }
folder=$1
shift
# parallel quotes what replaces {}, but takes the rest of its command for code.
{
  {
    printf '%s\0' "$folder"/*.csv |
      parallel -0 --keep-order "$@" "$(printf '%q ' "$here/fit.sh" "${body[@]}")" -- {} 2>&3 |
      awk '!/^#/ || !names++' >&4
  } 3>&1 | awk -f "$here/told.awk" >&2
} 4>&1
