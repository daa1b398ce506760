#include "amble/experiment/mutants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/mutation.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

constexpr std::int64_t seed = 5;

struct Sample {
  Config config;
  Problem problem;
  neat::Genome genome;
};

/// A SUPG that moves, under every kind of noise if `more` says so.
Sample sample(std::vector<std::string> more = {}) {
  more.insert(more.begin(), "engine=batch");
  Config config = small_config(std::move(more));
  Problem problem = small_problem(config);
  neat::Innovations innovations(problem.cppn_inputs(), problem.cppn_outputs(), config.neat.innovations);
  Stream stream(3, Purpose::test);
  neat::Genome genome = neat::initial_genome(config.neat.genome, problem.cppn_inputs(),
                                             problem.cppn_outputs(), innovations, stream);
  return {std::move(config), std::move(problem), std::move(genome)};
}

std::vector<record::Mutant> tried(const Sample& of, const MutantSettings& settings, int jobs = 1) {
  return try_mutants(of.problem, of.config.neat, of.genome, seed, settings, jobs, unstopped).value();
}

/// Score and duty factors of one genome by itself: means over the trials.
struct Walk {
  double score = 0.0;
  std::vector<double> duty_factors;
};
Walk walk_of(const Sample& of, const neat::Genome& genome, int episodes) {
  const auto scenarios = unseen_scenarios(of.problem, seed, 0, episodes, nullptr);
  Evaluator evaluator(of.problem, record::PathSampling(), 1, {.contacts = true});
  const auto result = evaluator.evaluate(std::vector{genome}, unstopped, scenarios);
  Walk walk{.score = 0.0, .duty_factors = std::vector<double>(of.problem.robot.legs.size())};
  const double share = 1.0 / static_cast<double>(result->episodes);
  for (const auto& trajectory : result->of_genome(0)) {
    walk.score += share * score::credited(of.problem.scorer().of(trajectory), trajectory.outcome,
                                          of.problem.trial.fall_factor);
    for (std::size_t leg = 0; leg < walk.duty_factors.size(); ++leg)
      walk.duty_factors[leg] += share * trajectory.contact_steps[leg] / trajectory.steps;
  }
  return walk;
}

TEST(Mutants, AreOneMutationAwayAndTriedInTheTrialsOfTheirParent) {
  for (const bool noisy : {false, true}) {
    const Sample of = sample(noisy ? all_noise() : std::vector<std::string>{});
    const int episodes = noisy ? 3 : 1;
    const Walk own = walk_of(of, of.genome, episodes);
    ASSERT_GT(own.score, 0.0);
    const auto mutants = tried(of, {.count = 12, .episodes = episodes});
    ASSERT_EQ(mutants.size(), 12u);
    for (std::uint32_t i = 0; i < 12; ++i) {
      neat::Genome genome = of.genome;
      auto innovations = neat::Innovations::beyond(of.genome, of.config.neat.innovations.key);
      Stream stream(seed, Purpose::mutants, 0, i);
      neat::mutate(genome, of.config.neat, of.problem.cppn.recurrent, innovations, stream);
      EXPECT_NE(genome, of.genome);
      const Walk walk = walk_of(of, genome, episodes);
      double change = 0.0;
      for (std::size_t leg = 0; leg < own.duty_factors.size(); ++leg)
        change += std::abs(walk.duty_factors[leg] - own.duty_factors[leg]) / 4.0;
      EXPECT_NEAR(mutants[i].kept, walk.score / own.score, 1e-6);
      EXPECT_NEAR(mutants[i].change, change, 1e-6);
    }
  }
}

TEST(Mutants, AreTheSameForAnyNumberOfWorkersAndTheFirstOfAnyNumberOfMutants) {
  const Sample of = sample(all_noise());
  const auto few = tried(of, {.count = 5, .episodes = 2}), many = tried(of, {.count = 40, .episodes = 2}, 3);
  EXPECT_EQ(std::vector(many.begin(), many.begin() + 5), few);
  std::set<double> different;
  for (const auto& mutant : many) different.insert(mutant.kept);
  EXPECT_GT(different.size(), 30u) << "they are not one mutant over and over";
}

TEST(Mutants, OfOtherSeedsAreOthers) {
  const Sample of = sample();
  const auto other =
      try_mutants(of.problem, of.config.neat, of.genome, seed + 1, {.count = 5}, 1, unstopped).value();
  EXPECT_NE(other, tried(of, {.count = 5}));
}

TEST(Mutants, OfAGenomeThatGetsNowhereKeepNothing) {
  Sample of = sample({"score.terms=[{quantity=\"distance\", weight=0}]"});
  for (const auto& mutant : tried(of, {.count = 3})) {
    EXPECT_EQ(mutant.kept, 0.0);
    EXPECT_FALSE(mutant.viable());
  }
}

TEST(Mutants, AreViableFromHalfOfTheScoreOn) {
  EXPECT_TRUE((record::Mutant{.kept = 0.5, .change = 0.0}.viable()));
  EXPECT_FALSE((record::Mutant{.kept = 0.499, .change = 0.0}.viable()));
}

TEST(Mutants, AreGivenUpWhenStopped) {
  const Sample of = sample();
  const std::atomic<bool> stopped{true};
  EXPECT_FALSE(try_mutants(of.problem, of.config.neat, of.genome, seed, {}, 1, stopped));
}

}  // namespace
}  // namespace amble::experiment
