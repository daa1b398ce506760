#include "amble/exporting/provenance.hpp"

#include <fmt/format.h>

#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/problem/problem_json.hpp"

namespace amble::exporting {

Provenance provenance_of(const experiment::Champion& champion) {
  const auto build = experiment::build_info();
  const experiment::TrialResult& result = champion.result;
  const std::string score = result.score ? fmt::format(", score {}", *result.score) : std::string();
  return {.amble = fmt::format("{} ({})", build.version, experiment::short_commit(build)),
          .experiment = champion.experiment,
          .seed = champion.seed,
          .generation = champion.generation,
          .index = champion.index,
          .engine = champion.problem.engine,
          .result = fmt::format("{} m in {} s, {}{}", result.distance_m, result.seconds,
                                record::outcome_names[to_index(result.outcome)], score),
          .settings_hash = hex(hash_text(experiment::problem_json(champion.problem).dump())),
          .genome_hash = hex(champion.genome.hash())};
}

}  // namespace amble::exporting
