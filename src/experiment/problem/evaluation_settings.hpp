#pragma once

#include <array>
#include <span>
#include <string_view>

#include "amble/io/settings.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::experiment {

/// When the noise of trials, and uneven ground, are drawn.
enum class Draw { each_generation, once };
inline constexpr std::array<std::string_view, 2> draw_names{"each_generation", "once"};

/// The generation whose noise and ground the trials of `generation` have.
constexpr int noise_generation(Draw draw, int generation) {
  return draw == Draw::once ? 0 : generation;
}

/// How the trials of a generation are spent under noise. The default is as many trials for each genome, under
/// noise that is new in each generation.
struct EvaluationSettings {
  Draw draw = Draw::each_generation;
  double finalists = 0.0;      ///< share of the genomes, the best, that are tried again; 0: none
  int finalist_episodes = 10;  ///< further trials of each of them

  void describe(io::SettingsVisitor& visitor);
  bool is_default() const { return draw == Draw::each_generation && finalists == 0.0; }
  /// Trials of the best genome of a generation.
  int episodes_of_best(int episodes) const {
    return finalists > 0.0 ? episodes + finalist_episodes : episodes;
  }
};

/// The objective of a genome from the scores (at least one) of its episodes.
double objective(trial::EpisodeScore combined, std::span<const double> scores);

}  // namespace amble::experiment
