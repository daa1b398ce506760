#include "amble/search/objective.hpp"

#include <cmath>

#include "amble/core/check.hpp"

namespace amble::search {

std::vector<neat::Fitness> ObjectiveSearch::fitness_of(std::span<const Evaluation> generation) {
  std::vector<neat::Fitness> fitness;
  fitness.reserve(generation.size());
  for (const Evaluation& evaluation : generation) {
    AMBLE_CHECK(std::isfinite(evaluation.objective) && evaluation.objective >= 0.0,
                "objectives are finite and >= 0");
    fitness.push_back({.selection = evaluation.objective, .objective = evaluation.objective});
  }
  return fitness;
}

}  // namespace amble::search
