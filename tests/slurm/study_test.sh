#!/usr/bin/env bash
# A study as a Slurm array on a real cluster of two nodes: one task is requeued, one is warned that its time is up, one is
# cancelled, and one node dies with all its processes. The ledger must be that of a run without any of it, by digest.
#   study_test.sh PROGRAM SOURCE_DIR
set -euo pipefail
program=$1 source=$2 here=$(cd "$(dirname "$0")" && pwd)
for tool in slurmctld slurmd munged sbatch; do
  command -v $tool >/dev/null || { echo "skipped: Slurm ($tool) is not installed"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: a cluster needs root"; exit 77; }

dir=$(mktemp -d /tmp/amble-slurm-XXXXXX)
cleanup() { scancel -f --user=root 2>/dev/null || true; "$here/cluster" down "$dir/c" || true; rm -rf "$dir"; }
trap cleanup EXIT
fail() { echo "FAILED: $*" >&2; squeue -o '%i %T %r %N' >&2 || true; tail -n 5 "$dir"/slurm-*.out >&2 || true; exit 1; }

cat >"$dir/study.toml" <<TOML
name = "array"
seeds = [1, 2]
generations = ${GENERATIONS:-100}
settings = ["engine=batch", "population.size=60", "speciation.target_min=4", "speciation.target_max=8"]
[[conditions]]
name = "supg"
config = "$source/configs/authors/supg-objective.toml"
[[conditions]]
name = "sine"
config = "$source/configs/authors/sine-objective.toml"
[[tests]]
name = "minute"
seconds = 60
TOML
digest() { sed -n 's/.*digest //p' | head -n 1; }
expected=$("$program" study "$dir/study.toml" --out "$dir/plain" 2>/dev/null | digest)

"$here/cluster" up "$dir/c"
export SLURM_CONF=$dir/c/slurm.conf
cd "$dir"
"$program" study study.toml --out array --slurm job.sh --tasks 4 --jobs 1
bash -n job.sh
job=$(sbatch --parsable --hold job.sh)

state() { squeue -h -r -j "${job}_$1" -o %T 2>/dev/null || true; }
wait_for() { # TASK STATE SECONDS
  for ((i = 0; i < 10 * $3; i++)); do [ "$(state "$1")" = "$2" ] && return 0; sleep 0.1; done
  fail "task $1 is not $2 but '$(state "$1")'"
}
# Each task is held until its turn and disturbed as soon as it has evaluated a generation: none can end before.
begun() { cat array/runs/*/generations.csv 2>/dev/null | grep -c '^1,' || true; }
begin() { # TASK
  scontrol release "${job}_$1"
  wait_for "$1" RUNNING 120
  for ((i = 0; i < 3000; i++)); do [ "$(begun)" -ge "$1" ] && return 0; sleep 0.01; done
  fail "task $1 began no run"
}
begin 1
scontrol requeue "${job}_1" # by hand
begin 2
# As at the end of its time. Slurm 22.05 delivers the signal, reports that it could not, and would send it again.
timeout 1 scancel --batch --signal=USR1 "${job}_2" || true
begin 3
scancel "${job}_3" # stays cancelled
begin 4
node=$(squeue -h -r -j "${job}_4" -o %N)
# The node loses its power: daemon, step, script and program at once. Its processes are those that name it or descend from one.
descendants() { for child in $(pgrep -P "$1" || true); do echo "$child"; descendants "$child"; done; }
daemon=$(cat "$dir/c/slurmd-$node.pid")
steps=$(pgrep -f "slurmstepd: \[${job}|slurmstepd: \[" || true)
victims="$daemon"
for step in $steps; do
  [ "$(tr '\0' ' ' <"/proc/$step/cmdline" 2>/dev/null)" ] || continue
  grep -qz "SLURMD_NODENAME=$node" "/proc/$(pgrep -P "$step" | head -n 1)/environ" 2>/dev/null || continue
  victims="$victims $step $(descendants "$step" | tr '\n' ' ')"
done
echo "killing $node: $victims"
# shellcheck disable=SC2086
kill -9 $victims 2>/dev/null || true
rm -f "$dir/c/slurmd-$node.pid"

for ((i = 0; i < 1800; i++)); do [ -z "$(squeue -h)" ] && break; sleep 0.1; done
[ -z "$(squeue -h)" ] || fail "the array did not end"
# Submitted again it does what is left: the cancelled task's shard.
second=$(sbatch --parsable job.sh)
for ((i = 0; i < 1800; i++)); do [ -z "$(squeue -h)" ] && break; sleep 0.1; done
[ -z "$(squeue -h)" ] || fail "job $second did not end"

for task in 1 2 3 4; do # requeued, warned, cancelled and killed in the middle of a run
  [ "$(grep -c "^0 of 1 runs  " "slurm-${job}_$task.out" "slurm-${second}_$task.out" | awk -F: '{n += $2} END {print n}')" -ge 2 ] ||
    fail "task $task was not interrupted"
done
status=$("$program" study study.toml --out array --status 2>&1)
actual=$(echo "$status" | digest)
echo "undisturbed $expected, array $actual"
grep -q "4 of 4 runs are done" <<<"$status" || fail "$status"
[ "$expected" = "$actual" ] || fail "the ledgers differ"
