#include "amble/experiment/champion_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/io/file.hpp"
#include "amble/record/generations_csv.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace champion_choice_test {

const std::atomic<bool> never{false};
constexpr int generations = 25;

Config judged_config(int episodes) {
  Config config = small_config({"engine=batch", "noise.push_m_s=0.3", "noise.push_interval_s=0.2",
                                "champion.episodes=" + std::to_string(episodes)});
  config.generations = generations;
  return config;
}

std::vector<Champion> champions(const std::filesystem::path& folder) {
  std::vector<Champion> all;
  for (const auto& file : RunPaths(folder).champion_files()) all.push_back(load_champion(file));
  return all;
}

/// Mean objective in trials `first` to `first` + `count` of those that decide, each evaluated by itself.
double judged(const Config& config, const Champion& champion, int count) {
  Evaluator evaluator(champion.problem, {}, 1);
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    trial::ScenarioKey key = episode_key(EpisodeSet::deciding, config.seed);
    key.episode += static_cast<std::uint32_t>(i);
    const std::vector<trial::Scenario> scenario{champion.problem.scenario(key, nullptr)};
    sum += objectives(champion.problem, *evaluator.evaluate(std::span(&champion.genome, 1), never, scenario))
               .front();
  }
  return sum / count;
}

void run(const std::filesystem::path& folder, const Config& config, int jobs) {
  Listener listener;
  ASSERT_EQ(Run::start(folder, config, jobs).execute(listener, listener.stop), RunStatus::finished);
}

TEST(ChampionChoice, KeepsWhatIsBetterInTheTrialsThatDecideAndNotWhatWasLucky) {
  const TemporaryFolder scratch;
  constexpr int episodes = 6;
  const Config config = judged_config(episodes);
  run(scratch / "run", config, 2);
  const auto kept = champions(scratch / "run");
  ASSERT_GE(kept.size(), 3u);
  for (std::size_t i = 1; i < kept.size(); ++i)
    EXPECT_GT(judged(config, kept[i], episodes), judged(config, kept[i - 1], episodes));

  const auto table = record::read_generations(RunPaths(scratch / "run").generations);
  EXPECT_GT(std::ranges::max(table.best), table.best_so_far.back()) << "the luckiest is not the champion";
  EXPECT_EQ(table.best_so_far.back(), kept.back().objective());
  for (std::size_t i = 0, champion = 0; i < table.count(); ++i) {
    const bool has_champion = champion < kept.size() && kept[champion].generation == static_cast<int>(i);
    EXPECT_EQ(record::keeps_champion(table, i), has_champion) << i;
    if (has_champion) {
      EXPECT_EQ(kept[champion].objective(), table.best[i]);
      ++champion;
    }
  }
}

TEST(ChampionChoice, ChangesNoGenerationOfEvolution) {
  const TemporaryFolder scratch;
  run(scratch / "lucky", judged_config(0), 1);
  run(scratch / "judged", judged_config(4), 1);
  const auto lucky = record::read_generations(RunPaths(scratch / "lucky").generations),
             of_judged = record::read_generations(RunPaths(scratch / "judged").generations);
  EXPECT_EQ(lucky.best, of_judged.best);
  EXPECT_EQ(lucky.mean_links, of_judged.mean_links);
  EXPECT_NE(lucky.best_so_far, of_judged.best_so_far);
}

TEST(ChampionChoice, IsTheSameForAnyWorkersAndAfterAnInterruption) {
  const TemporaryFolder scratch;
  const Config config = judged_config(4);
  run(scratch / "whole", config, 1);
  run(scratch / "workers", config, 3);
  Config first = config;
  first.generations = 11;
  run(scratch / "parts", first, 2);
  Listener listener;
  ASSERT_EQ(Run::resume(scratch / "parts", generations, 2).execute(listener, listener.stop),
            RunStatus::finished);
  const auto files = [&](const char* folder) {
    std::string all;
    for (const auto& file : RunPaths(scratch / folder).champion_files())
      all += file.filename().string() + io::read_file(file);
    return all;
  };
  EXPECT_EQ(files("workers"), files("whole"));
  EXPECT_EQ(files("parts"), files("whole"));
}

TEST(ChampionChoice, HasChampionsThatVerify) {
  const TemporaryFolder scratch;
  run(scratch / "run", judged_config(4), 2);
  const RunPaths paths(scratch / "run");
  Origin origin = origin_of(paths);
  origin.table = record::read_generations(paths.generations);
  for (const auto& file : paths.champion_files())
    EXPECT_TRUE(verify_champion(file, never, &origin).value().agrees) << file;
}

TEST(ChampionChoice, ByTheMedianKeepsWhatTypicallyDoesBest) {
  const TemporaryFolder scratch;
  Config config = judged_config(7);
  config.champion.score = ChampionScore::median;
  run(scratch / "run", config, 2);
  const auto kept = champions(scratch / "run");
  ASSERT_GE(kept.size(), 3u);
  double before = -1.0;
  for (const Champion& champion : kept) {
    std::vector<double> scores;
    for (std::uint32_t i = 0; i < 7; ++i) {
      trial::ScenarioKey key = episode_key(EpisodeSet::deciding, config.seed);
      key.episode += i;
      const std::vector<trial::Scenario> scenario{champion.problem.scenario(key, nullptr)};
      Evaluator evaluator(champion.problem, {}, 1);
      scores.push_back(
          objectives(champion.problem, *evaluator.evaluate(std::span(&champion.genome, 1), never, scenario))
              .front());
    }
    std::ranges::sort(scores);
    EXPECT_GT(scores[3], before);
    before = scores[3];
  }
}

TEST(ChampionChoice, NeedsNoise) {
  try {
    small_config({"champion.episodes=4"});
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr(
                    "champion.episodes = 4: without any noise they would all be the same; expected 0"));
  }
}

TEST(ChampionChoice, IsNoPartOfAConfigsIdentityUnlessItIsMade) {
  EXPECT_FALSE(identity_json(small_config()).contains("champion"));
  EXPECT_TRUE(identity_json(judged_config(4)).contains("champion"));
  EXPECT_FALSE(identity_json(judged_config(4)).at("champion").contains("score"))
      << "as before it could be chosen";
}

}  // namespace champion_choice_test
}  // namespace amble::experiment
