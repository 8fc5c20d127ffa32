#!/usr/bin/env bash
# table.sh FOLDER [OPTION-OF-parallel]...: one table of the fits of all records in FOLDER, by GNU
# parallel: as many at a time as there are processors, or as the options say. On other machines too,
# if they have the tools on their PATH:
#   samples/fleet/table.sh run --sshlogin 8/ann,8/ben,: --transferfile {} \
#     --basefile samples/fleet/fit.sh --cleanup
set -euo pipefail
export LC_ALL=C
unset CDPATH
[ $# -gt 0 ] || { echo "table.sh: say the folder: table.sh FOLDER [OPTION]..." >&2; exit 2; }
folder=$1 program=$(dirname "$0")/fit.sh
shift
# parallel quotes what replaces {}, but takes the rest of its command for code.
printf '%s\0' "$folder"/*.csv |
  parallel -0 --keep-order "$@" "$(printf %q "$program")" {} | awk '!/^#/ || !names++'
