#!/usr/bin/env bash
# Tasks of a Slurm job array that share one piece of long work, each by the command that a single machine would run,
# with a folder that all nodes see (docs/cluster.md):
#     sbatch --array=1-100 scripts/cluster/slurm.sh obscura-bench sweep STUDY --measure errors --out FOLDER
# What stands below, sbatch's own options override.
#SBATCH --job-name=obscura
#SBATCH --array=1-8
#SBATCH --cpus-per-task=2
#SBATCH --output=obscura-%A_%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
set -u
[ $# -gt 0 ] || { echo "usage: sbatch --array=1-N $0 COMMAND..." >&2; exit 2; }

# Slurm itself requeues tasks whose node fails or that are preempted. Who is killed alone, as by a kernel out of memory,
# asks for it; an error would come again, and ends the task.
"$@"
status=$?
if [ $status = 137 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 20 ]; then
    echo "slurm.sh: killed on $(hostname); queued again" >&2
    scontrol requeue "$SLURM_JOB_ID"
fi
exit $status
