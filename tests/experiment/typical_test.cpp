#include "amble/experiment/typical.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/record/generations_csv.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace typical_test {

std::vector<double> distances_m(const std::vector<TrialResult>& trials) {
  std::vector<double> all;
  for (const TrialResult& trial : trials) all.push_back(trial.distance_m);
  return all;
}

Problem batch_problem(std::vector<std::string> more = {}) {
  more.push_back("engine=batch");
  return small_problem(small_config(more));
}

neat::Genome a_genome(const Problem& problem) {
  return small_population(problem).genomes()[5];
}

TEST(TypicalTrials, AreTheTrialsThatAReplayOfTheirKeysGives) {
  const Problem problem = batch_problem(all_noise());
  const neat::Genome genome = a_genome(problem);
  TypicalTrials trials(problem, 3, 20);
  const auto all = trials.run(genome, unstopped).value();
  trial::ScenarioKey key = episode_key(EpisodeSet::typical, 3);
  for (const TrialResult& trial : all) {
    const auto alone = replay(trials.problem(), genome, {.noise = key}, unstopped).value();
    EXPECT_EQ(trial.distance_m, alone.result.distance_m) << key.episode;
    EXPECT_EQ(trial.outcome, alone.result.outcome) << key.episode;
    ++key.episode;
  }
}

TEST(TypicalTrials, AreTheSameForAnyNumberOfWorkers) {
  for (const char* engine : {"batch", "ode"}) {
    const Problem problem = small_problem(small_config({std::string("engine=") + engine}));
    const neat::Genome genome = a_genome(problem);
    const auto one = TypicalTrials(problem, 1, 7, "milli", 1).run(genome, unstopped).value();
    const auto three = TypicalTrials(problem, 1, 7, "milli", 3).run(genome, unstopped).value();
    EXPECT_EQ(distances_m(one), distances_m(three)) << engine;
  }
}

TEST(TypicalTrials, AreUnderTheNoiseOfTheRunOrElseAtTheDefaultLevel) {
  const Problem quiet = batch_problem(), noisy = batch_problem(all_noise());
  EXPECT_EQ(TypicalTrials(quiet, 1, 1).level().under(), "at the level milli");
  EXPECT_EQ(TypicalTrials(noisy, 1, 1).level().under(), "under its own noise");
  EXPECT_EQ(TypicalTrials(noisy, 1, 1, "micro").level().under(), "at the level micro");
  EXPECT_EQ(TypicalTrials(noisy, 1, 1, "micro").problem().noise.push_m_s, 0.0);
  EXPECT_THROW(TypicalTrials(quiet, 1, 1, "own"), UserError);
  EXPECT_THROW(TypicalTrials(quiet, 1, 1, "nano"), UserError);
}

TEST(TypicalTrials, AtTheLevelControlGiveTheUndisturbedBits) {
  const Problem problem = batch_problem();
  const neat::Genome genome = a_genome(problem);
  const double undisturbed_m = replay(problem, genome, {}, unstopped).value().result.distance_m;
  const auto control = TypicalTrials(problem, 1, 5, "control").run(genome, unstopped).value();
  EXPECT_THAT(distances_m(control), testing::Each(undisturbed_m));
  const auto milli = TypicalTrials(problem, 1, 5, "milli").run(genome, unstopped).value();
  EXPECT_THAT(distances_m(milli), testing::Not(testing::Contains(undisturbed_m)));
}

TEST(TypicalTrials, AreNoneOfThoseThatEvolutionOrTheChoiceOfChampionsHas) {
  const auto set_of = [](const trial::ScenarioKey& key) { return ground_of(key).set; };
  EXPECT_EQ(set_of({.seed = 1, .generation = 7, .episode = 999}), 0u);
  EXPECT_EQ(set_of(episode_key(EpisodeSet::unseen, 1)), 1u);
  EXPECT_EQ(set_of(episode_key(EpisodeSet::deciding, 1)), 1000u);
  EXPECT_EQ(set_of(episode_key(EpisodeSet::typical, 1)), 2000u);
}

TEST(MedianTrial, HasTheMedianDistanceOrTheLowerOfTheTwoInTheMiddle) {
  const Problem problem = batch_problem(all_noise());
  const neat::Genome genome = a_genome(problem);
  for (const int count : {1, 4, 7}) {
    TypicalTrials trials(problem, 2, count);
    auto sorted_m = distances_m(trials.run(genome, unstopped).value());
    std::ranges::sort(sorted_m);
    const auto median = median_trial(trials, genome, 2, unstopped).value();
    EXPECT_EQ(replay(median.problem, genome, {.noise = median.key}, unstopped).value().result.distance_m,
              sorted_m[static_cast<std::size_t>(count - 1) / 2]);
    EXPECT_EQ(median.distance.trials, static_cast<std::size_t>(count));
  }
}

TEST(TypicalText, SaysTheMedianQuartilesFallsAndTheLuckiest) {
  const score::Typical typical{.trials = 64,
                               .median = 3.123,
                               .lower_quartile = 2.4,
                               .upper_quartile = 3.8,
                               .best = 5.1,
                               .fell_share = 0.03125};
  EXPECT_EQ(
      typical_text(typical, {}, 15.0, "at the level milli"),
      "typically 3.12 m in 15 s: half of 64 trials at the level milli 2.40 to 3.80 m, 3 % fell (luckiest "
      "5.10 m)");
}

TEST(Run, TellsWhatItsChampionTypicallyDoesInEveryGeneration) {
  const TemporaryFolder scratch;
  Config config = small_config(all_noise());
  config.engine = "batch";
  config.generations = 8;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "run", config, 2).execute(listener, listener.stop), RunStatus::finished);
  const RunPaths paths(scratch / "run");
  const auto table = record::read_generations(paths.generations);
  ASSERT_EQ(table.typical.size(), 8u);
  for (const auto& file : paths.champion_files()) {
    const auto champion = load_champion(file);
    TypicalTrials trials(champion.problem, champion.seed, running_trials);
    const auto typical = typical_objective(champion.problem, trials.run(champion.genome, unstopped).value());
    const auto generation = static_cast<std::size_t>(champion.generation);
    EXPECT_EQ(table.typical[generation], typical.median);
    EXPECT_EQ(table.typical_lower[generation], typical.lower_quartile);
    EXPECT_EQ(table.typical_upper[generation], typical.upper_quartile);
    EXPECT_EQ(table.typical_fell[generation], typical.fell_share);
  }
}

}  // namespace typical_test
}  // namespace amble::experiment
