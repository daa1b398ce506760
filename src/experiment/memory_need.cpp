#include "amble/experiment/memory_need.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "amble/core/error.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {
namespace {

namespace fs = std::filesystem;

/// Share of the whole; the rest is for other processes.
constexpr double usable_share = 0.8;

/// What `ulimit -v` or `-d` allow.
double limit_of_process_bytes() {
  double least = std::numeric_limits<double>::infinity();
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      least = std::min(least, static_cast<double>(limit.rlim_cur));
  }
  return least;
}

double machine_memory_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// The process's group, relative to the folder of all groups; empty for the topmost one, and where there are
/// none of version 2.
fs::path group_of_process(const fs::path& process_groups) {
  std::ifstream file(process_groups);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("0::/")) return line.substr(4);
  return {};
}

constexpr double giga = 1e9;

}  // namespace

double usable_memory_bytes(const fs::path& process_groups, const fs::path& groups) {
  double bytes = std::min(machine_memory_bytes(), limit_of_process_bytes());
  // The limits of all groups above apply, too. "max", which is no number, means none.
  for (fs::path group = group_of_process(process_groups);; group = group.parent_path()) {
    double limit_bytes = 0.0;
    if (std::ifstream(groups / group / "memory.max") >> limit_bytes) bytes = std::min(bytes, limit_bytes);
    if (group.empty()) break;
  }
  return usable_share * bytes;
}

MemoryNeed memory_of_generation(const Config& config, const Problem& problem) {
  const double genomes = candidates_per_generation(config),
               episodes = problem.trials_vary() ? config.noise.episodes : 1.0,
               numbers = static_cast<double>(config.make_behaviour()->length());
  // Parents and children, and the generation whose trials are remembered (TrialMemory), with four times the
  // links they start with.
  const double links = 4.0 * (problem.cppn_inputs() + 1.0) * problem.cppn_outputs();
  const double genome_bytes = 3.0 * links * static_cast<double>(sizeof(neat::LinkGene));
  const double trial_bytes = static_cast<double>(sizeof(record::Trajectory)) + numbers * sizeof(float);
  const bool map = config.search.kind == "map-elites";
  const std::string key = map ? "search.map_elites.batch" : "population.size";
  MemoryNeed need{.bytes = genomes * (2.0 * episodes * trial_bytes + numbers * sizeof(float) + genome_bytes),
                  .what = fmt::format("{} = {}", key, genomes),
                  .keys = {key}};
  if (episodes > 1.0) {
    need.what += fmt::format(" × noise.episodes = {}", episodes);
    need.keys.emplace_back("noise.episodes");
  }
  if (numbers > 0.0 && !map) {
    need.what +=
        fmt::format(" × behaviours of {} numbers (trial.duration_s, search.novelty.path_stride)", numbers);
    need.keys.emplace_back("search.novelty.path_stride");
  }
  return need;
}

UserError out_of_memory(const Config& config, const Problem& problem) {
  const auto need = memory_of_generation(config, problem);
  return UserError(
      fmt::format("not enough memory: asked for {:.2g} GB and more by {}, beside archives and what each of "
                  "--jobs workers needs; expected less of these, or a higher limit (ulimit -v, the job's "
                  "memory)",
                  need.bytes / giga, need.what),
      ExitCode::io);
}

}  // namespace amble::experiment
