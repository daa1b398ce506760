#include "amble/experiment/plan/typical_level.hpp"

#include <fmt/format.h>

#include <vector>

#include "amble/core/error.hpp"
#include "amble/record/levels.hpp"

namespace amble::experiment {
namespace {

using record::own_noise;

score::Typical typical_of(std::span<const TrialResult> trials, auto value) {
  std::vector<double> values;
  std::vector<record::Outcome> outcomes;
  for (const TrialResult& trial : trials) {
    values.push_back(value(trial));
    outcomes.push_back(trial.outcome);
  }
  return score::typical(values, outcomes);
}

}  // namespace

TypicalLevel typical_level(const Problem& problem, const std::string& asked) {
  const bool own = asked == own_noise || (asked.empty() && problem.trials_vary());
  if (own && !problem.trials_vary())
    fail(ExitCode::bad_input, "level '{}': it was evolved without noise, and from one place; expected {}",
         asked, record::level_names());
  TypicalLevel found{.name = std::string(own_noise), .noise = problem.noise};
  if (!own) {
    const record::Level* const level = record::find_level(asked.empty() ? record::default_level : asked);
    if (level == nullptr)
      fail(ExitCode::bad_input, "level '{}': expected {} or {}", asked, own_noise, record::level_names());
    found = {.name = std::string(level->name), .noise = trial::noise_of(*level)};
  }
  found.noise.first_undisturbed = false;
  return found;
}

std::string TypicalLevel::under() const {
  if (name.empty()) return "under the noise of " + from;
  return name == own_noise ? "under its own noise" : fmt::format("at the level {}", name);
}

score::Typical typical_distance(std::span<const TrialResult> trials) {
  return typical_of(trials, [](const TrialResult& trial) { return trial.distance_m; });
}

score::Typical typical_objective(const Problem& problem, std::span<const TrialResult> trials) {
  return typical_of(trials, [&problem](const TrialResult& trial) {
    return problem.credited(trial.value(), trial.outcome);
  });
}

}  // namespace amble::experiment
