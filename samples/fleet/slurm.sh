#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#SBATCH --job-name=rolling --ntasks=1 --cpus-per-task=1 --time=10
# The table by a job array of Slurm: task i of n fits each n-th run of the folder, from the i-th
# on, to part.i. What is told of them stands in the output of the task. From the top of the source:
#   sbatch --wait --array=0-9 samples/fleet/slurm.sh -K 0.5 -R 0.04 run
#   awk '!/^#/ || !names++' run/part.* >run/table.txt
set -euo pipefail
export LC_ALL=C
unset CDPATH
[ $# -ge 5 ] || { echo "slurm.sh: say what rolled, and the folder: slurm.sh -K 0.5 -R 0.04 FOLDER" >&2; exit 2; }
folder=${!#}
runs=("$folder"/*.csv)
fits() {
  local i status=0
  for ((i = SLURM_ARRAY_TASK_ID; i < ${#runs[@]}; i += SLURM_ARRAY_TASK_COUNT)); do
    samples/fleet/fit.sh "$@" -- "${runs[i]}" || status=$?
  done
  return $status
}
fits "${@:1:$#-1}" 2>&1 >"$folder/part.$SLURM_ARRAY_TASK_ID" | awk -f samples/fleet/told.awk >&2
