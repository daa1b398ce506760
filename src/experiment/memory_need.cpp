#include "amble/experiment/memory_need.hpp"

#include <fmt/format.h>

#include "amble/core/error.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {
namespace {

constexpr double giga = 1e9;

}  // namespace

MemoryNeed memory_of_generation(const Config& config, const Problem& problem) {
  const double genomes = candidates_per_generation(config),
               episodes = problem.trials_vary() ? config.noise.episodes : 1.0,
               numbers = static_cast<double>(config.make_behaviour()->length());
  // Parents and children, with four times the links they start with.
  const double links = 4.0 * (problem.cppn_inputs() + 1.0) * problem.cppn_outputs();
  const double genome_bytes = 2.0 * links * static_cast<double>(sizeof(neat::LinkGene));
  const double trial_bytes = static_cast<double>(sizeof(record::Trajectory)) + numbers * sizeof(float);
  const bool map = config.search.kind == "map-elites";
  const std::string key = map ? "search.map_elites.batch" : "population.size";
  MemoryNeed need{.bytes = genomes * (episodes * trial_bytes + numbers * sizeof(float) + genome_bytes),
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
