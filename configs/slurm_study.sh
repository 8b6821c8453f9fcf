#!/bin/bash
# A study in twenty shares by Slurm: sbatch configs/slurm_study.sh STUDY.json, then
#   skinfit study merge STUDY.json part_*.sqlite
# A share that was killed goes on where it was when it is submitted again: sbatch --array=7 configs/slurm_study.sh STUDY.json
#SBATCH --job-name=skinfit
#SBATCH --array=1-20
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
set -u
parts=${SLURM_ARRAY_TASK_MAX:-20}
skinfit study run "$1" --part "$SLURM_ARRAY_TASK_ID/$parts" --ledger "part_$SLURM_ARRAY_TASK_ID.sqlite" \
    --threads "${SLURM_CPUS_PER_TASK:-1}"
status=$?
# 1: some spectra are suspect, rejected or failed. The share is done.
[ "$status" -le 1 ]
