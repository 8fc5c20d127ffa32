#!/usr/bin/env bash
#SBATCH --job-name=rolling --ntasks=1 --cpus-per-task=1 --time=10 --output=/dev/null
# The table by a job array of Slurm: task i of n fits each n-th record of the folder, from the i-th
# on, to part.i. From the top of the source:
#   sbatch --wait --array=0-9 samples/fleet/slurm.sh run && sort -u run/part.* >run/table.txt
set -euo pipefail
export LC_ALL=C
unset CDPATH
records=("$1"/*.csv)
for ((i = SLURM_ARRAY_TASK_ID; i < ${#records[@]}; i += SLURM_ARRAY_TASK_COUNT)); do
  samples/fleet/fit.sh "${records[i]}"
done >"$1/part.$SLURM_ARRAY_TASK_ID"
