#include "amble/experiment/trial_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "amble/score/score.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

const std::atomic<bool> stopped{true};

/// Twelve genomes of which three are equal, and two others.
std::vector<neat::Genome> with_doubles(const Problem& problem) {
  const auto population = small_population(problem);
  std::vector<neat::Genome> genomes(population.genomes().begin(), population.genomes().begin() + 12);
  genomes[4] = genomes[9] = genomes[1];
  genomes[11] = genomes[10];
  return genomes;
}

void expect_equal(const GenerationResult& a, const GenerationResult& b) {
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.episodes, b.episodes);
  ASSERT_EQ(a.trajectories.size(), b.trajectories.size());
  for (std::size_t i = 0; i < a.trajectories.size(); ++i) {
    EXPECT_EQ(a.trajectories[i].steps, b.trajectories[i].steps) << i;
    EXPECT_EQ(a.trajectories[i].com_path_m, b.trajectories[i].com_path_m) << i;
    EXPECT_EQ(score::distance_m(a.trajectories[i]), score::distance_m(b.trajectories[i])) << i;
  }
}

TEST(TrialMemory, GivesWhatTryingAllGives) {
  for (const auto& problem : {small_problem(), noisy_problem()}) {
    const auto scenarios = problem.scenarios(1, 3);
    Evaluator evaluator(problem, {.stride = 20}, 2);
    TrialMemory memory;
    auto genomes = with_doubles(problem);
    for (int round = 0; round < 3; ++round) {
      expect_equal(memory.evaluate(evaluator, genomes, unstopped, {1, 3}, scenarios, nullptr).value(),
                   evaluator.evaluate(genomes, unstopped, scenarios).value());
      // Some stay, at other places, and some are new.
      std::ranges::rotate(genomes, genomes.begin() + 5);
      genomes[0].links[0].weight += 0.25;
    }
  }
}

TEST(TrialMemory, TriesNobodyAgainWhoWasThereBefore) {
  const auto problem = small_problem();
  Evaluator evaluator(problem, {}, 1);
  TrialMemory memory;
  auto genomes = with_doubles(problem);
  ASSERT_TRUE(memory.evaluate(evaluator, genomes, unstopped, {1, 0}, {}, nullptr));
  // A trial that is stopped gives nothing, so what is given was not tried.
  std::ranges::reverse(genomes);
  EXPECT_TRUE(memory.evaluate(evaluator, genomes, stopped, {1, 0}, {}, nullptr));
  genomes[3].links[0].weight += 0.25;
  EXPECT_FALSE(memory.evaluate(evaluator, genomes, stopped, {1, 0}, {}, nullptr));
  ASSERT_TRUE(memory.evaluate(evaluator, genomes, unstopped, {1, 0}, {}, nullptr));
  EXPECT_TRUE(memory.evaluate(evaluator, genomes, stopped, {1, 0}, {}, nullptr)) << "the latest are known";
}

TEST(TrialMemory, TriesAllAgainUnderOtherNoise) {
  const auto problem = noisy_problem();
  Evaluator evaluator(problem, {}, 1);
  TrialMemory memory;
  const auto genomes = with_doubles(problem);
  ASSERT_TRUE(memory.evaluate(evaluator, genomes, unstopped, {1, 3}, problem.scenarios(1, 3), nullptr));
  for (const TrialDraw& draw : {TrialDraw{1, 4}, TrialDraw{2, 3}}) {
    const auto scenarios = problem.scenarios(draw.seed, draw.generation);
    EXPECT_FALSE(memory.evaluate(evaluator, genomes, stopped, draw, scenarios, nullptr));
  }
}

TEST(TrialMemory, KnowsOnlyTheGenerationBefore) {
  const auto problem = small_problem();
  Evaluator evaluator(problem, {}, 1);
  TrialMemory memory;
  const auto genomes = with_doubles(problem);
  const std::span<const neat::Genome> all = genomes;
  ASSERT_TRUE(memory.evaluate(evaluator, all.first(4), unstopped, {1, 0}, {}, nullptr));
  ASSERT_TRUE(memory.evaluate(evaluator, all.subspan(5, 3), unstopped, {1, 0}, {}, nullptr));
  EXPECT_FALSE(memory.evaluate(evaluator, all.first(4), stopped, {1, 0}, {}, nullptr));
}

}  // namespace
}  // namespace amble::experiment
