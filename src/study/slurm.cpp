#include "amble/study/slurm.hpp"

#include <fmt/format.h>

#include <cctype>

#include "amble/core/check.hpp"
#include "amble/io/quoting.hpp"

namespace amble::study {
namespace {

std::string job_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') c = '-';
  return text;
}

}  // namespace

std::string slurm_script(const SlurmJob& job) {
  AMBLE_CHECK(job.tasks > 0 && job.jobs > 0 && job.per_run > 0 && job.minutes > 0,
              "a job has tasks, processors and time");
  const std::string cpus = "${SLURM_CPUS_PER_TASK:-" + std::to_string(job.jobs) + "}";
  return fmt::format(
      R"(#!/bin/bash
# {tasks} tasks, each a shard of the study. Submit with sbatch; submitted again, it does what is left.
#SBATCH --job-name={name}
#SBATCH --array=1-{tasks}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={cpus}
#SBATCH --time={minutes}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@60
#SBATCH --output=slurm-%A_%a.out

{plugins}{program} study {file} --out {out} --shard "$SLURM_ARRAY_TASK_ID/{tasks}" --jobs "{jobs}"{more} &
child=$!
out_of_time=
trap 'out_of_time=1; kill -TERM $child 2>/dev/null' USR1  # a minute before the time limit
trap 'kill -TERM $child 2>/dev/null' TERM                 # scancel, preemption, requeue
wait $child
code=$?
# A trap ends the first wait; only the second one has the exit code of the program.
if [ $code -gt 128 ]; then wait $child; code=$?; fi
# Stopped for lack of time: the run folders hold what is done, and the same task goes on.
if [ $code = 7 ] && [ "$out_of_time" ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit $code
)",
      fmt::arg("name", job_name(job.name)), fmt::arg("tasks", job.tasks), fmt::arg("cpus", job.jobs),
      fmt::arg("jobs", cpus),
      fmt::arg("more", (job.per_run == 1 ? "" : fmt::format(" --per-run {}", job.per_run)) +
                           (job.discard_runs ? " --discard-runs" : "")),
      fmt::arg("plugins", job.plugins.empty()
                              ? std::string()
                              : fmt::format("export AMBLE_PLUGINS={}\n", io::shell_quoted(job.plugins))),
      fmt::arg("minutes", job.minutes), fmt::arg("program", io::shell_quoted(job.program.string())),
      fmt::arg("file", io::shell_quoted(job.file.string())),
      fmt::arg("out", io::shell_quoted(job.out.string())));
}

}  // namespace amble::study
