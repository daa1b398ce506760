#include "amble/experiment/evaluator.hpp"

#include <gtest/gtest.h>

#include "amble/experiment/replay.hpp"
#include "amble/score/distance.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

const std::atomic<bool> never{false};

TEST(Evaluator, GivesWhatOneTrialAfterTheOtherGives) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, 0, 3);
  const auto result = evaluator.evaluate(population.genomes(), never);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->trajectories.size(), population.genomes().size());
  for (std::size_t i = 0; i < population.genomes().size(); i += 5) {
    const auto alone = replay(problem, population.genomes()[i], {}, never);
    EXPECT_EQ(score::distance_m(result->trajectories[i]), alone->result.distance_m) << i;
    EXPECT_EQ(result->trajectories[i].steps, alone->result.steps) << i;
  }
}

TEST(Evaluator, RepeatsItselfRoundAfterRound) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, 2, 2);
  const auto first = evaluator.evaluate(population.genomes(), never);
  const auto second = evaluator.evaluate(population.genomes(), never);
  for (std::size_t i = 0; i < population.genomes().size(); ++i)
    EXPECT_EQ(first->trajectories[i].com_path_m, second->trajectories[i].com_path_m);
  EXPECT_EQ(first->steps, second->steps);
}

TEST(Evaluator, GivesNothingWhenItIsStopped) {
  const auto problem = small_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, 0, 2);
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(evaluator.evaluate(population.genomes(), stop));
  EXPECT_TRUE(evaluator.evaluate(population.genomes(), never)) << "and works again afterwards";
}

}  // namespace
}  // namespace amble::experiment
