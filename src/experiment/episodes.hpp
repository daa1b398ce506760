#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::experiment {

/// The trials numbered `first`, `first` + 1, … of EpisodeSet::unseen, for `count` trials of any genome; none
/// for a problem without noise. `ground` is that of their keys. Nothing once `stop` is true.
std::optional<std::vector<trial::Scenario>> unseen_scenarios(const Problem& problem, std::int64_t seed,
                                                             int first, int count,
                                                             const ground::Ground* ground,
                                                             const std::atomic<bool>& stop);
/// The objective of each genome of a generation, by the problem's score; Morse et al. 2013, sec. 4: m.
std::vector<double> objectives(const Problem& problem, const GenerationResult& result);

}  // namespace amble::experiment
