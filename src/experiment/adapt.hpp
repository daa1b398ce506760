#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "amble/adaptation/trial_and_error.hpp"
#include "amble/damage/settings.hpp"
#include "amble/experiment/repertoire.hpp"

namespace amble::experiment {

/// A robot that is not what its map was made with.
struct AdaptSettings {
  std::string engine = "ode";  ///< takes the place of the real robot
  damage::Settings damage;
  int most_trials = 20;
  int episodes = 1;  ///< attempts under different noise whose mean is the result of one trial
  adaptation::TrialAndErrorSettings search = {};
  int test_trials = 20;  ///< trials that judge a gait before and after, under noise unseen by the search
};

/// One trial of the search.
struct AdaptStep {
  std::uint32_t cell = 0;
  double expected = 0.0;   ///< by the map
  double predicted = 0.0;  ///< by what was known before the trial, and its standard deviation
  double deviation = 0.0;
  double measured = 0.0;
};

struct Adaptation {
  std::vector<AdaptStep> steps;  ///< the first is the map's best
  bool done = false;             ///< stopped because nothing better was predicted, not for lack of trials
  std::uint32_t cell = 0;        ///< of the elite found: TrialAndError::best()
  // Means over the judging trials: the map's best before the damage and after it, and the elite found.
  double intact = 0.0, damaged = 0.0, adapted = 0.0;
};

/// What the robot of an adaptation does: its engine and its damage.
Problem damaged_problem(const Repertoire& repertoire, const AdaptSettings& settings);

/// Intelligent trial and error (adaptation/trial_and_error.hpp) over the elites of a map, with trials of the
/// damaged robot in another engine; each under noise of its own, if the map was made under noise. The result
/// is the same for any number of `jobs`. Nothing if `stop` was set. Throws UserError: an unknown engine,
/// damage that the robot cannot have, an empty map, several episodes where none differ.
std::optional<Adaptation> adapt(const Repertoire& repertoire, const AdaptSettings& settings, int jobs,
                                const std::atomic<bool>& stop);

/// The search and what came of it as a document of docs/FORMATS.md. `damage`: as it was asked for.
std::string adaptation_json(const Adaptation& adaptation, const Repertoire& repertoire,
                            const AdaptSettings& settings, const std::string& damage);

}  // namespace amble::experiment
