#include "amble/experiment/generation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/score/behaviour.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Config noisy_config(std::vector<std::string> more = {}) {
  const auto noise = all_noise();
  more.insert(more.begin(), noise.begin(), noise.end());
  more.push_back("engine=batch");
  return small_config(more);
}

EvaluatedGeneration evaluated(const Config& config, int generation = 3, int jobs = 1) {
  const Problem problem = small_problem(config);
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, jobs);
  GenerationMemory memory;
  return evaluate_generation(evaluator, problem, config.evaluation, memory, config.seed, generation,
                             population.genomes(), unstopped)
      .value();
}

TEST(Finalists, AreTheBestShareInTheirOrder) {
  const std::array objectives{1.0, 5.0, 3.0, 5.0, 2.0, 4.0};
  EXPECT_THAT(finalists_of(objectives, 0.5), ElementsAre(1u, 3u, 5u));
  EXPECT_THAT(finalists_of(objectives, 1.0), ElementsAre(0u, 1u, 2u, 3u, 4u, 5u));
}

TEST(Finalists, AreAtLeastOneAndOfEqualsTheFirst) {
  EXPECT_THAT(finalists_of(std::array{1.0, 2.0, 2.0}, 1e-6), ElementsAre(1u));
}

TEST(Generation, BestIsAFinalistEvenIfOthersCountAsMuch) {
  EvaluatedGeneration evaluated{.result = {}, .objectives = {0.5, 0.2, 0.5, 0.1}};
  EXPECT_EQ(evaluated.best(), 0u);
  evaluated.finalists = {2};
  EXPECT_EQ(evaluated.best(), 2u);
  evaluated.finalists = {1, 2, 3};
  EXPECT_EQ(evaluated.best(), 2u);
}

TEST(EvaluatedGeneration, OfFinalistsCountsAllTheirTrialsAndOfOthersNoMoreThanTheWorstOfThem) {
  const Config plain = noisy_config(),
               halved = noisy_config({"evaluation.finalists=0.2", "evaluation.finalist_episodes=5"});
  const auto before = evaluated(plain), after = evaluated(halved);
  const auto finalists = finalists_of(before.objectives, 0.2);
  ASSERT_EQ(finalists.size(), 8u);

  // Each finalist alone, in two trials and five more.
  Problem problem = small_problem(halved);
  problem.noise.episodes = 7;
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 1);
  double worst = 1e9;
  for (const std::size_t i : finalists) {
    const auto alone = evaluator.evaluate(std::span(&population.genomes()[i], 1), unstopped,
                                          problem.scenarios(halved.seed, 3));
    EXPECT_EQ(after.objectives[i], objectives(problem, *alone).front()) << i;
    worst = std::min(worst, after.objectives[i]);
  }
  bool has_cut = false;
  for (std::size_t i = 0; i < before.objectives.size(); ++i) {
    if (std::ranges::count(finalists, i) > 0) continue;
    EXPECT_EQ(after.objectives[i], std::min(before.objectives[i], worst)) << i;
    has_cut |= before.objectives[i] > worst;
  }
  EXPECT_TRUE(has_cut) << "luck was cut off somewhere";
  EXPECT_EQ(after.result.trajectories.size(), before.result.trajectories.size());
  EXPECT_GT(after.result.steps, before.result.steps);
}

TEST(EvaluatedGeneration, OfAFinalistWhoseFurtherTrialDivergedTellsTheSearchThatItIsNotViable) {
  EvaluatedGeneration generation{
      .result = {}, .objectives = {0.5, 0.2}, .finalists = {0, 1}, .diverged = {1}};
  generation.result.episodes = 1;
  generation.result.trajectories.resize(2);
  const auto told_of = experiment::told(generation, *score::make_behaviour("", {}));
  EXPECT_TRUE(told_of.evaluations[0].viable);
  EXPECT_FALSE(told_of.evaluations[1].viable);
}

TEST(EvaluatedGeneration, IsTheSameForAnyNumberOfWorkers) {
  const Config config = noisy_config({"evaluation.finalists=0.1", "noise.score=lower_quartile"});
  EXPECT_EQ(evaluated(config, 2, 1).objectives, evaluated(config, 2, 3).objectives);
}

TEST(EvaluatedGeneration, HasNewNoiseInEachGenerationUnlessItIsDrawnOnce) {
  EXPECT_NE(evaluated(noisy_config(), 1).objectives, evaluated(noisy_config(), 2).objectives);
  const Config once = noisy_config({"evaluation.draw=once"});
  EXPECT_EQ(evaluated(once, 1).objectives, evaluated(once, 2).objectives);
  EXPECT_EQ(evaluated(once, 1).objectives, evaluated(noisy_config(), 0).objectives);
}

class RunWithSettings : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Evaluation, RunWithSettings,
                         testing::Values("evaluation.finalists=0.2", "evaluation.draw=once"));

TEST_P(RunWithSettings, IsTheSameAfterAnInterruptionAndHasChampionsThatVerify) {
  const TemporaryFolder scratch;
  Config config = noisy_config({GetParam()});
  config.generations = 12;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "whole", config, 1).execute(listener, listener.stop), RunStatus::finished);
  Config first = config;
  first.generations = 5;
  ASSERT_EQ(Run::start(scratch / "parts", first, 3).execute(listener, listener.stop), RunStatus::finished);
  ASSERT_EQ(Run::resume(scratch / "parts", 12, 2).execute(listener, listener.stop), RunStatus::finished);
  EXPECT_EQ(champion_bytes(scratch / "parts"), champion_bytes(scratch / "whole"));

  const RunPaths paths(scratch / "whole");
  Origin origin = origin_of(paths);
  origin.table = record::read_generations(paths.generations);
  for (const auto& file : paths.champion_files())
    EXPECT_TRUE(verify_champion(file, unstopped, &origin).value().agrees)
        << verify_champion(file, unstopped, &origin).value().text;
}

std::string refusal(std::vector<std::string> settings) {
  try {
    small_config(std::move(settings));
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

TEST(EvaluationSettings, ThatMakeNoSenseAreRefused) {
  EXPECT_THAT(refusal({"evaluation.finalists=0.1"}),
              HasSubstr("evaluation.finalists = 0.1: without any noise"));
  EXPECT_THAT(refusal({"noise.push_m_s=0.1", "noise.episodes=900", "evaluation.finalists=0.1",
                       "evaluation.finalist_episodes=200"}),
              HasSubstr("noise.episodes + evaluation.finalist_episodes = 1100: expected at most 1000"));
  EXPECT_THAT(refusal({"evaluation.draw=never"}), HasSubstr("each_generation"));
  EXPECT_EQ(refusal({"noise.push_m_s=0.1", "evaluation.finalists=0.1"}), "");
}

TEST(EvaluationSettings, AreNoPartOfAConfigsIdentityUnlessTheyChangeIt) {
  EXPECT_FALSE(identity_json(small_config({"evaluation.finalist_episodes=3"})).contains("evaluation"));
  EXPECT_TRUE(identity_json(noisy_config({"evaluation.draw=once"})).contains("evaluation"));
}

}  // namespace
}  // namespace amble::experiment
