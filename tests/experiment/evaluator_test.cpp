#include "amble/experiment/evaluator.hpp"

#include <gtest/gtest.h>

#include "amble/experiment/replay.hpp"
#include "amble/score/score.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace evaluator_test {

const std::atomic<bool> never{false};

TEST(Evaluator, GivesWhatOneTrialAfterTheOtherGives) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 3);
  const auto result = evaluator.evaluate(population.genomes(), never);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->trajectories.size(), population.genomes().size());
  for (std::size_t i = 0; i < population.genomes().size(); i += 5) {
    const auto alone = replay(problem, population.genomes()[i], {}, never);
    EXPECT_EQ(score::distance_m(result->trajectories[i]), alone->result.distance_m) << i;
    EXPECT_EQ(result->trajectories[i].steps, alone->result.steps) << i;
  }
}

TEST(Evaluator, GivesEachGenomeATrialPerScenario) {
  const auto problem = noisy_problem();
  const auto population = small_population(problem);
  const auto scenarios = problem.scenarios(1, 3);
  ASSERT_EQ(scenarios.size(), 2u);
  std::vector<GenerationResult> results;
  for (const int jobs : {1, 3}) {
    Evaluator evaluator(problem, {}, jobs);
    results.push_back(evaluator.evaluate(population.genomes(), never, scenarios).value());
    EXPECT_EQ(results.back().episodes, 2u);
    ASSERT_EQ(results.back().trajectories.size(), 2 * population.genomes().size());
  }
  EXPECT_EQ(results[0].steps, results[1].steps);
  std::uint64_t steps = 0;
  for (std::size_t i = 0; i < population.genomes().size(); ++i) {
    for (std::uint32_t episode = 0; episode < 2; ++episode) {
      const auto& trajectory = results[0].of_genome(i)[episode];
      steps += static_cast<std::uint64_t>(trajectory.steps);
      EXPECT_EQ(score::distance_m(trajectory), score::distance_m(results[1].of_genome(i)[episode]));
      if (i % 10 != 0) continue;
      ReplayOptions options;
      options.noise = trial::ScenarioKey{.seed = 1, .generation = 3, .episode = episode};
      EXPECT_EQ(score::distance_m(trajectory),
                replay(problem, population.genomes()[i], options, never)->result.distance_m);
    }
  }
  EXPECT_EQ(results[0].steps, steps) << "of all episodes";
}

TEST(Evaluator, WorksOnAfterARoundWithNoise) {
  const auto problem = noisy_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 2);
  const auto before = evaluator.evaluate(population.genomes(), never);
  {
    const auto scenarios = problem.scenarios(1, 0);
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(evaluator.evaluate(population.genomes(), stop, scenarios));
    EXPECT_TRUE(evaluator.evaluate(population.genomes(), never, scenarios));
  }
  const auto after = evaluator.evaluate(population.genomes().first(3), never);
  ASSERT_EQ(after->trajectories.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(score::distance_m(before->trajectories[i]), score::distance_m(after->trajectories[i]));
}

TEST(Evaluator, RepeatsItselfRoundAfterRound) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {.stride = 2}, 2);
  const auto first = evaluator.evaluate(population.genomes(), never);
  const auto second = evaluator.evaluate(population.genomes(), never);
  for (std::size_t i = 0; i < population.genomes().size(); ++i)
    EXPECT_EQ(first->trajectories[i].com_path_m, second->trajectories[i].com_path_m);
  EXPECT_EQ(first->steps, second->steps);
}

TEST(Evaluator, GivesNothingWhenItIsStopped) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 2);
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(evaluator.evaluate(population.genomes(), stop));
  EXPECT_TRUE(evaluator.evaluate(population.genomes(), never)) << "and works again afterwards";
}

}  // namespace evaluator_test
}  // namespace amble::experiment
