#pragma once

#include <span>
#include <string>
#include <string_view>

#include "amble/experiment/problem/champion.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/score/typical.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::experiment {

/// Trials that tell what a walker typically does while a run goes on.
inline constexpr int running_trials = 16;
/// What disturbs a problem's typical trials.
struct TypicalLevel {
  std::string name;  ///< of a record::Level, or record::own_noise; empty: noise from elsewhere
  trial::NoiseSettings noise;
  std::string from = {};  ///< where that noise is from: a config's name

  /// "under its own noise", "at the level milli" or "under the noise of windy.toml".
  std::string under() const;
};
/// `asked`: a level's name, or record::own_noise; empty: own noise where the problem has some, else
/// record::default_level. Throws UserError for an unknown level, and for own noise where there is none.
TypicalLevel typical_level(const Problem& problem, const std::string& asked = {});

/// The typical distance of the trials, m.
score::Typical typical_distance(std::span<const TrialResult> trials);
/// The same of what they count in evolution: the problem's score, with its factor for falls.
score::Typical typical_objective(const Problem& problem, std::span<const TrialResult> trials);

}  // namespace amble::experiment
