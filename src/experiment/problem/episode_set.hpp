#pragma once

#include <cstdint>

namespace amble::experiment {

/// What trials under noise are for. No trial of one set has the noise or, on uneven ground, the ground of
/// another. The numbers are part of the reproducibility promise.
enum class EpisodeSet : std::uint32_t {
  evolution = 0,    ///< evaluations; each generation has its own
  unseen = 1,       ///< tests and comparisons; it has the numbers up to those of `deciding`
  deciding = 1000,  ///< what decides on champions
  typical = 2000,   ///< what tells what a champion typically does; decides on nothing
};

/// Episodes of an evaluation at most.
inline constexpr std::uint32_t most_evolution_episodes = 1000;
/// Trials of EpisodeSet::unseen at most.
inline constexpr std::uint32_t most_unseen_episodes = 999'000;

/// The number of trial n, from 0, of a set: trial::ScenarioKey::episode.
constexpr std::uint32_t episode_number(EpisodeSet set, std::uint32_t n) {
  return static_cast<std::uint32_t>(set) * most_evolution_episodes + n;
}

/// The number of an episode's ground: ground::Key::set. Of EpisodeSet::unseen each thousand has its own.
constexpr std::uint32_t ground_number(std::uint32_t episode) {
  return episode / most_evolution_episodes;
}

}  // namespace amble::experiment
