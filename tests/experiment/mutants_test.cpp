#include "amble/experiment/mutants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/problem/episode_set.hpp"
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

/// A SUPG that moves.
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

/// Under every kind of noise, where evolution counts the worst episode.
Sample noisy_sample() {
  auto settings = all_noise();
  settings.push_back("noise.score=worst");
  return sample(std::move(settings));
}

std::vector<trial::ScenarioKey> keys(int count) {
  std::vector<trial::ScenarioKey> keys;
  for (int i = 0; i < count; ++i)
    keys.push_back({.seed = 8,
                    .generation = 2,
                    .episode = episode_number(EpisodeSet::unseen, static_cast<std::uint32_t>(i))});
  return keys;
}

MutationOutcome tried(const Sample& of, int count, const std::vector<trial::ScenarioKey>& trials = {},
                      int jobs = 1) {
  return try_mutants(of.problem, of.config.neat, of.genome, count, seed, trials, jobs, unstopped).value();
}

/// Score and duty factors of one genome by itself: means over the trials.
struct Walk {
  double score = 0.0;
  std::vector<double> duty_factors;
};
Walk walk_of(const Sample& of, const neat::Genome& genome, const std::vector<trial::ScenarioKey>& trials) {
  const auto ground = of.problem.make_ground(trials.empty() ? of.problem.ground_key : ground_of(trials[0]));
  std::vector<trial::Scenario> scenarios;
  for (const auto& key : trials) scenarios.push_back(of.problem.scenario(key, ground.get()));
  Evaluator evaluator(of.problem, record::PathSampling(), 1, {.contacts = true});
  const auto result = evaluator.evaluate(std::vector{genome}, unstopped, scenarios, ground);
  Walk walk{.score = 0.0, .duty_factors = std::vector<double>(of.problem.robot.legs.size())};
  const double share = 1.0 / static_cast<double>(result->episodes);
  for (const auto& trajectory : result->of_genome(0)) {
    walk.score += share * score::credited(of.problem.make_score().of(trajectory), trajectory.outcome,
                                          of.problem.trial.fall_factor);
    for (std::size_t leg = 0; leg < walk.duty_factors.size(); ++leg)
      walk.duty_factors[leg] += share * trajectory.contact_steps[leg] / trajectory.steps;
  }
  return walk;
}

void expect_one_mutation_each(const Sample& of, const std::vector<trial::ScenarioKey>& trials) {
  const Walk own = walk_of(of, of.genome, trials);
  ASSERT_GT(own.score, 0.0);
  const MutationOutcome outcome = tried(of, 12, trials);
  EXPECT_NEAR(outcome.score, own.score, 1e-9);
  ASSERT_EQ(outcome.mutants.size(), 12u);
  for (std::uint32_t i = 0; i < 12; ++i) {
    neat::Genome genome = of.genome;
    auto innovations = neat::Innovations::beyond(of.genome, of.config.neat.innovations.key);
    Stream stream(seed, Purpose::mutants, 0, i);
    neat::mutate(genome, of.config.neat, of.problem.cppn.recurrent, innovations, stream);
    EXPECT_NE(genome, of.genome);
    const Walk walk = walk_of(of, genome, trials);
    double change = 0.0;
    for (std::size_t leg = 0; leg < own.duty_factors.size(); ++leg)
      change += std::abs(walk.duty_factors[leg] - own.duty_factors[leg]) / 4.0;
    EXPECT_NEAR(outcome.mutants[i].kept, walk.score / own.score, 1e-6);
    EXPECT_NEAR(outcome.mutants[i].change, change, 1e-6);
  }
}

TEST(Mutants, AreOneMutationAwayAndMeetTheTrialsOfTheirParent) {
  expect_one_mutation_each(sample(), {});
}

TEST(Mutants, UnderNoiseCountByTheMeanOfTheirTrials) {
  expect_one_mutation_each(noisy_sample(), keys(3));
}

TEST(Mutants, WalkOnTheGroundOfTheirTrials) {
  const Sample of = sample(
      {"ground.kind=stones", "ground.height_m=0.1", "ground.start_place_m=2", "ground.vary=generations"});
  expect_one_mutation_each(of, keys(2));
  expect_one_mutation_each(of, {});
  EXPECT_NE(tried(of, 1, keys(2)).score, tried(of, 1).score);
}

TEST(Mutants, AreTheSameForAnyNumberOfWorkersAndTheFirstOfAnyNumberOfMutants) {
  const Sample of = noisy_sample();
  const auto few = tried(of, 5, keys(2)).mutants, many = tried(of, 1100, keys(2), 3).mutants;
  ASSERT_EQ(many.size(), 1100u);
  EXPECT_EQ(std::vector(many.begin(), many.begin() + 5), few);
  std::set<double> different;
  for (const auto& mutant : many) different.insert(mutant.kept);
  EXPECT_GT(different.size(), 500u) << "they are not one mutant over and over";
}

TEST(Mutants, OfOtherSeedsAreOthers) {
  const Sample of = sample();
  const auto other =
      try_mutants(of.problem, of.config.neat, of.genome, 5, seed + 1, {}, 1, unstopped).value();
  EXPECT_NE(other.mutants, tried(of, 5).mutants);
}

TEST(Mutants, OfAGenomeThatGetsNowhereKeepNothing) {
  const Sample of = sample({"score.terms=[{quantity=\"distance\", weight=0}]"});
  const MutationOutcome outcome = tried(of, 3);
  EXPECT_EQ(outcome.score, 0.0);
  for (const auto& mutant : outcome.mutants) {
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
  EXPECT_FALSE(try_mutants(of.problem, of.config.neat, of.genome, 5, seed, {}, 1, stopped));
}

}  // namespace
}  // namespace amble::experiment
