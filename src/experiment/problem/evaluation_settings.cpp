#include "amble/experiment/problem/evaluation_settings.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {

void EvaluationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "draw", draw, draw_names,
      {"when noise and uneven ground are drawn: anew in each generation, or once for the whole run"});
  visitor.number(
      "finalists", finalists, {0.0, 1.0},
      {"share of a generation, its best, that is tried again before anything is selected; 0: none"});
  visitor.integer("finalist_episodes", finalist_episodes, {1, 500},
                  {"further trials of each of them; what counts is noise.score of all its trials"});
}

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
