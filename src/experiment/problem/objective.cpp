#include "amble/experiment/problem/objective.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {

double objective(trial::EpisodeScore combined, std::span<const double> scores) {
  AMBLE_CHECK(!scores.empty(), "an evaluation has an episode");
  switch (combined) {
    case trial::EpisodeScore::worst:
      return std::ranges::min(scores);
    case trial::EpisodeScore::median:
      return statistics::median(scores);
    case trial::EpisodeScore::lower_quartile:
      return statistics::quantile(scores, 0.25);
    case trial::EpisodeScore::mean:
      break;
  }
  double sum = 0.0;
  for (const double score : scores) sum += score;
  return sum / static_cast<double>(scores.size());
}

}  // namespace amble::experiment
