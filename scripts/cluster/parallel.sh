#!/usr/bin/env bash
# parallel.sh WORKERS LOGS COMMAND...: so many workers share one piece of long work by GNU parallel, each by the command
# that one alone would run, with one --out (docs/cluster.md):
#     scripts/cluster/parallel.sh 8 logs obscura-bench sweep STUDY --measure errors --out FOLDER
# Who is killed begins again. LOGS gets a list of the tasks and the output of each. On several desktops, with a folder
# that all see under one name: PARALLEL="--sshloginfile HOSTS --workdir ." scripts/cluster/parallel.sh ...
set -eu
[ $# -ge 3 ] || { echo "usage: $0 WORKERS LOGS COMMAND..." >&2; exit 2; }
workers=$1 logs=$2
shift 2
mkdir -p "$logs"
# -N0: the numbers of the workers are no arguments of the command.
parallel --will-cite -N0 -q --jobs "$workers" --retries 20 --joblog "$logs/tasks.tsv" --results "$logs/{#}" "$@" ::: $(seq "$workers")
