#!/usr/bin/env bash
# @TITLE@; written by @WRITER@ from scripts/jobs/job.sh.
#SBATCH --job-name=@NAME@
#SBATCH --ntasks=@RANKS@
#SBATCH --time=@TIME@
#SBATCH --output=@LOG@
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=B:USR1@@SECONDS@
@OPTIONS@
set -u
cd @HERE@ || exit 1
titin=@TITIN@ folder=@FOLDER@
arguments=(@ARGUMENTS@)
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then   # a sweep: a file for each case, an argument a line
  folder+=/$(printf %04d "$SLURM_ARRAY_TASK_ID")
  mapfile -t arguments <"$folder.arguments"
fi
@SETUP@

say() { printf '[job] %s %s\n' "$(date +%H:%M:%S)" "$*"; }
again=${SLURM_RESTART_COUNT:-0}
earlier=(@EARLIER@)   # what to do with a run that is there when the job starts for the first time
[ "$again" = 0 ] || earlier=(--resume)
[ -n "${SLURM_ARRAY_TASK_ID:-}" ] && [ -e "$folder/run.json" ] && earlier=(--resume)
[ "$again" = 0 ] && rm "$folder.anew" 2>/dev/null && earlier=(--overwrite)
# A job that was requeued goes on from its last checkpoint; one that lost its node before the first checkpoint starts anew.
if [ "${earlier[*]-}" = --resume ]; then
  if ls "$folder"/checkpoints/*.h5 >/dev/null 2>&1; then earlier=(--restart "$folder"); else earlier=(--overwrite -o "$folder"); fi
else earlier+=(-o "$folder")
fi

say "job $SLURM_JOB_ID on $SLURM_JOB_NODELIST, start $((again + 1)): titin run ${arguments[*]} ${earlier[*]}"
@LAUNCHER@ "$titin" run "${arguments[@]}" "${earlier[@]}" &
run=$!
near_limit=0
trap 'near_limit=1; say "the time limit is near: asking the run to stop"; kill -USR1 "$run"' USR1
trap 'kill -USR1 "$run"' TERM
code=0
while :; do
  wait "$run" && code=0 || code=$?
  kill -0 "$run" 2>/dev/null || break   # a trapped signal ends `wait` too
done
say "exit code $code"
@AFTER@
if [ "$code" = 3 ] && [ "$near_limit" = 1 ]; then
  if [ "$again" -lt @REQUEUES@ ]; then
    say "requeued to go on from its last checkpoint"
    scontrol requeue "$SLURM_JOB_ID"
  else say "not requeued: that was done @REQUEUES@ times; go on with scripts/submit --restart $folder"
  fi
fi
exit "$code"
