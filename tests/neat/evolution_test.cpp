#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "amble/neat/population.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

#ifdef AMBLE_SANITIZED
constexpr std::uint64_t seeds = 2;
#else
constexpr std::uint64_t seeds = 5;
#endif

constexpr std::array<std::array<double, 3>, 4> exclusive_or{
    {{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}};

/// 0 … 8: the sum over the four cases of 2 − |error| for outputs and targets of ±1.
double exclusive_or_score(const Genome& genome) {
  double score = 0.0;
  for (const auto& [a, b, target] : exclusive_or) {
    const std::array<double, 2> inputs{a, b};
    score += 2.0 - std::min(2.0, std::abs(feed_forward(genome, inputs)[0] - target));
  }
  return score;
}

bool solves_exclusive_or(const Genome& genome) {
  for (const auto& [a, b, target] : exclusive_or) {
    const std::array<double, 2> inputs{a, b};
    if (feed_forward(genome, inputs)[0] * target < 0.5) return false;
  }
  return true;
}

/// The first generation in which a genome solves it, or −1. Without a hidden node none can: it is not
/// linearly separable.
int generations_to_solve(Settings settings, std::uint64_t seed, int most) {
  settings.population.size = 150;
  settings.speciation.target_min = 8;
  settings.speciation.target_max = 12;
  settings.speciation.initial_threshold = 20;
  settings.genome.weight_limit = 5;
  settings.mutation.weights.jiggle_limit = 0.5;
  settings.mutation.add_node_share = 0.05;
  Population population(settings, 2, 1, false, seed);
  for (int generation = 0; generation < most; ++generation) {
    for (const Genome& genome : population.genomes())
      if (solves_exclusive_or(genome)) {
        EXPECT_GE(genome.count(NodeKind::hidden), 1);
        return generation;
      }
    population.advance(evaluate(population, exclusive_or_score));
  }
  return -1;
}

TEST(Evolution, SolvesExclusiveOrWithAllFunctions) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const int generations = generations_to_solve({}, seed, 200);
    EXPECT_GE(generations, 1) << "seed " << seed;
  }
}

TEST(Evolution, SolvesExclusiveOrWithSigmoidsAlone) {
  Settings settings;
  settings.genome.activation_shares = {1, 0, 0, 0};
  settings.mutation.split_link = SplitLink::disable;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const int generations = generations_to_solve(settings, seed, 400);
    EXPECT_GE(generations, 1) << "seed " << seed;
  }
}

}  // namespace
}  // namespace amble::neat
