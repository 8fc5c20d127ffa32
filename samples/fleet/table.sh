#!/bin/bash
# table.sh FOLDER [OPTION-OF-parallel]...: one table of the fits of all records in FOLDER, by GNU parallel: as many at a time as there
# are processors, or as its options say. On other machines too, which have the tools on their PATH:
#   samples/fleet/table.sh run --sshlogin 8/ann,8/ben,: --transferfile {} --basefile samples/fleet/fit.sh --cleanup
set -euo pipefail
folder=$1
shift
printf '%s\n' "$folder"/*.csv | parallel --keep-order "$@" "$(dirname "$0")/fit.sh" | awk '!/^#/ || !names++'
