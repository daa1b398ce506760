#include "amble/experiment/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"
#include "amble/record/generations_csv.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

/// What must not depend on workers or interruptions: genomes, distances and traces are all in the champions.
std::string champions(const std::filesystem::path& folder) {
  std::string all;
  for (const auto& file : RunPaths(folder).champion_files())
    all += file.filename().string() + io::read_file(file);
  return all;
}

/// The archive of a run under novelty search or MAP-Elites; "" of another.
std::string archive(const std::filesystem::path& folder) {
  const auto path = folder / "archive.bin";
  return std::filesystem::exists(path) ? io::read_file(path) : "";
}

struct Way {
  std::string name;
  std::string kind = "objective";
  bool noise = false;
  std::string engine = "ode";
};

class EachWay : public testing::TestWithParam<Way> {
 protected:
  Config config() const {
    auto more = GetParam().noise ? all_noise() : std::vector<std::string>{};
    if (GetParam().noise) more.push_back("drop_m=0.01");
    more.push_back("engine=" + GetParam().engine);
    if (GetParam().kind == "map-elites") return small_map_config(more);
    return GetParam().kind == "novelty" ? small_novelty_config(more) : small_config(more);
  }
};

INSTANTIATE_TEST_SUITE_P(Run, EachWay,
                         testing::Values(Way{"objective"}, Way{"novelty", "novelty"},
                                         Way{"novelty_under_noise", "novelty", true},
                                         Way{"batch", "objective", false, "batch"},
                                         Way{"batch_novelty_under_noise", "novelty", true, "batch"},
                                         Way{"map", "map-elites", false, "batch"},
                                         Way{"map_under_noise", "map-elites", true, "batch"}),
                         [](const auto& way) { return way.param.name; });

TEST_P(EachWay, GivesTheSameChampionsAndArchiveForAnyNumberOfWorkers) {
  const TemporaryFolder scratch;
  std::string first, first_archive;
  for (const int jobs : {1, 2, 4}) {
    const auto folder = scratch / std::to_string(jobs);
    Listener listener;
    EXPECT_EQ(Run::start(folder, config(), jobs).execute(listener, listener.stop), RunStatus::finished);
    if (first.empty()) first = champions(folder), first_archive = archive(folder);
    EXPECT_EQ(champions(folder), first);
    EXPECT_EQ(archive(folder), first_archive);
  }
}

TEST_P(EachWay, GoesOnAfterAnInterruptionAsIfThereHadBeenNone) {
  const TemporaryFolder scratch;
  Listener whole;
  Run::start(scratch / "whole", config(), 2).execute(whole, whole.stop);
  Listener part(1);
  EXPECT_EQ(Run::start(scratch / "part", config(), 2).execute(part, part.stop), RunStatus::interrupted);
  Listener rest;
  EXPECT_EQ(Run::resume(scratch / "part", {}, 2).execute(rest, rest.stop), RunStatus::finished);
  EXPECT_EQ(champions(scratch / "part"), champions(scratch / "whole"));
  EXPECT_EQ(archive(scratch / "part"), archive(scratch / "whole"));
  ASSERT_EQ(rest.rows.size(), 2u);
  EXPECT_EQ(rest.rows.back().best_so_far, whole.rows.back().best_so_far);
}

TEST_P(EachWay, ACheckpointThatIsWholeButNotYetNamedCountsIfTheOtherFilesKeepUpWithIt) {
  const TemporaryFolder scratch;
  const RunPaths early(scratch / "early"), late(scratch / "late");
  Listener first(1), second(2);
  Run::start(early.folder, config(), 2).execute(first, first.stop);
  Run::start(late.folder, config(), 2).execute(second, second.stop);
  const auto next = io::read_file(late.checkpoint);
  const auto unnamed = early.checkpoint.string() + std::string(io::temporary_mark) + "4711";
  // Cut off while it was written, and on the disk before the line of its generation was.
  for (const auto& left : {next.substr(0, 10), next.substr(0, next.size() - 1), next}) {
    io::write_file(unnamed, left);
    EXPECT_EQ(Run::resume(early.folder, {}, 1).generation(), 1) << left.size();
    EXPECT_FALSE(std::filesystem::exists(unnamed));
  }
  std::filesystem::copy(
      late.champions, early.champions,
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::update_existing);
  const auto old = io::read_file(early.checkpoint);
  io::write_file(early.generations, io::read_file(late.generations));
  if (std::filesystem::exists(late.folder / "archive.bin")) {
    io::write_file(unnamed, next);
    EXPECT_EQ(Run::resume(early.folder, {}, 1).generation(), 1) << "its archive is not there";
    io::write_file(early.generations, io::read_file(late.generations));
    io::write_file(early.folder / "archive.bin", io::read_file(late.folder / "archive.bin"));
  }
  const auto copy = early.checkpoint.string() + ".tmp.bak";
  io::write_file(copy, next);
  EXPECT_EQ(Run::resume(early.folder, {}, 1).generation(), 1) << "a copy that somebody made";
  EXPECT_TRUE(std::filesystem::exists(copy));
  io::write_file(early.generations, io::read_file(late.generations));
  if (std::filesystem::exists(late.folder / "archive.bin"))
    io::write_file(early.folder / "archive.bin", io::read_file(late.folder / "archive.bin"));

  io::write_file(unnamed, next);
  EXPECT_EQ(Run::resume(early.folder, {}, 1).generation(), 2);
  EXPECT_EQ(io::read_file(early.checkpoint), next);
  io::write_file(unnamed, old);
  EXPECT_EQ(Run::resume(early.folder, {}, 1).generation(), 2) << "an older one";
}

TEST_P(EachWay, CanBeResumedBeforeItsFirstGenerationIsDone) {
  const TemporaryFolder scratch;
  Run::start(scratch / "run", config(), 1);
  Listener listener;
  EXPECT_EQ(Run::resume(scratch / "run", {}, 1).execute(listener, listener.stop), RunStatus::finished);
  const auto csv = io::read_file(RunPaths(scratch / "run").generations);
  EXPECT_TRUE(csv.starts_with("generation,best,best_so_far,mean,median,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3);
}

TEST_P(EachWay, CannotBeMadeShorterThanItIs) {
  const TemporaryFolder scratch;
  Listener listener;
  Run::start(scratch / "run", config(), 2).execute(listener, listener.stop);
  const auto before = io::read_file(RunPaths(scratch / "run").config);
  try {
    Run::resume(scratch / "run", 1, 2);
    ADD_FAILURE() << "accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("3 generations are done already, --generations 1"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(io::read_file(RunPaths(scratch / "run").config), before);
}

TEST_P(EachWay, KeepsAChampionOfEachGenerationThatIsBetterThanAllBeforeAndOfNoOther) {
  const TemporaryFolder scratch;
  Listener listener;
  auto longer = config();
  longer.generations = 8;
  Run::start(scratch / "run", longer, 2).execute(listener, listener.stop);
  std::vector<std::pair<int, double>> expected, kept;
  for (const GenerationRow& row : listener.rows) {
    if (expected.empty() || row.best > expected.back().second)
      expected.emplace_back(row.generation, row.best);
    EXPECT_EQ(row.best_so_far, expected.back().second);
  }
  for (const auto& file : RunPaths(scratch / "run").champion_files()) {
    const Champion champion = load_champion(file);
    kept.emplace_back(champion.generation, champion.objective());
  }
  EXPECT_EQ(kept, expected);
}

TEST(Run, KeepsNoChampionOfAGenerationThatOnlyEqualsTheBest) {
  const TemporaryFolder scratch;
  Listener listener;
  auto config = small_config({"engine=batch"});
  config.generations = 12;
  config.neat.reproduction.lone_place = neat::LonePlace::elite;
  Run::start(scratch / "run", config, 2).execute(listener, listener.stop);
  std::size_t better = 1, equal = 0;
  for (std::size_t i = 1; i < listener.rows.size(); ++i) {
    better += listener.rows[i].best > listener.rows[i - 1].best_so_far;
    equal += listener.rows[i].best == listener.rows[i - 1].best_so_far;
  }
  ASSERT_GT(equal, 0u) << "elites are carried over, and trials repeat";
  EXPECT_EQ(RunPaths(scratch / "run").champion_files().size(), better);
}

TEST(Run, NeverLosesItsBestDistanceWithoutNoiseWhereLonePlacesAreForElites) {
  for (auto config : {small_config(), small_novelty_config()}) {
    const TemporaryFolder scratch;
    Listener listener;
    config.generations = 6;
    config.neat.reproduction.lone_place = neat::LonePlace::elite;
    Run::start(scratch / "run", config, 2).execute(listener, listener.stop);
    for (std::size_t i = 1; i < listener.rows.size(); ++i)
      EXPECT_GE(listener.rows[i].best, listener.rows[i - 1].best)
          << "elites are carried over, and trials repeat";
  }
}

TEST(NoisyRun, CountsGenomesAsEvaluationsAndTheStepsOfAllEpisodes) {
  const TemporaryFolder scratch;
  Listener listener;
  auto config = small_config({"noise.episodes=3", "noise.touch_flip_probability=0.001"});
  config.generations = 1;
  Run::start(scratch / "run", config, 2).execute(listener, listener.stop);
  EXPECT_EQ(listener.rows[0].evaluations, 40u);
  EXPECT_GT(listener.rows[0].steps, 2u * 40u * 100u) << "more than two episodes can have";
}

TEST(NoisyRun, KeepsChampionsByTheirObjectiveUnderNoise) {
  const TemporaryFolder scratch;
  Listener listener;
  auto more = all_noise();
  more.push_back("noise.score=worst");
  Run::start(scratch / "run", small_config(more), 2).execute(listener, listener.stop);
  const auto champion = load_champion(RunPaths(scratch / "run").best_champion());
  EXPECT_EQ(champion.objective(), listener.rows.back().best_so_far);
  EXPECT_EQ(champion.problem.noise.score, trial::EpisodeScore::worst);
  ASSERT_EQ(champion.episodes.size(), 2u);
  EXPECT_EQ(champion.objective(),
            std::min(champion.episodes[0].result.distance_m, champion.episodes[1].result.distance_m));
}

TEST(NoveltyRun, FillsItsArchiveAndReportsIt) {
  const TemporaryFolder scratch;
  Listener listener;
  const auto config = small_novelty_config();
  Run::start(scratch / "run", config, 2).execute(listener, listener.stop);
  ASSERT_EQ(listener.rows.size(), 3u);
  std::size_t before = 0;
  for (const auto& row : listener.rows) {
    const auto members = static_cast<std::size_t>(row.metric("archive").value());
    EXPECT_GT(members, before);
    EXPECT_GT(row.metric("best_novelty").value(), row.metric("novelty_threshold").value());
    before = members;
  }
  EXPECT_EQ(config.make_behaviour()->length(), 100u);
  EXPECT_EQ(archive(scratch / "run").size(), 16 + before * (100 * 4 + 8));
}

TEST(NoveltyRun, CutsAnArchiveBackThatIsAheadOfItsCheckpoint) {
  const TemporaryFolder scratch;
  Listener whole, part(1), rest;
  Run::start(scratch / "whole", small_novelty_config(), 1).execute(whole, whole.stop);
  Run::start(scratch / "part", small_novelty_config(), 1).execute(part, part.stop);
  const RunPaths paths(scratch / "part");
  io::write_file(paths.folder / "archive.bin",
                 io::read_file(paths.folder / "archive.bin") + std::string(1000, 'x'));
  io::write_file(paths.generations, io::read_file(paths.generations) + "1,2,3");
  Run::resume(scratch / "part", {}, 1).execute(rest, rest.stop);
  EXPECT_EQ(archive(scratch / "part"), archive(scratch / "whole"));
  EXPECT_EQ(champions(scratch / "part"), champions(scratch / "whole"));
}

TEST(MapRun, FillsItsMapAndReportsIt) {
  const TemporaryFolder scratch;
  Listener listener;
  const auto config = small_map_config(all_noise());
  Run::start(scratch / "run", config, 2).execute(listener, listener.stop);
  ASSERT_EQ(listener.rows.size(), 3u);
  const GenerationRow& row = listener.rows.back();
  EXPECT_EQ(row.evaluations, 32u) << "a batch, not a population";
  EXPECT_GT(row.metric("elites").value(), 1.0);
  EXPECT_EQ(row.metric("coverage").value(), row.metric("elites").value() / (4 * 6));
  EXPECT_GT(row.metric("reevaluated").value(), 0.0);
  EXPECT_GE(row.metric("qd_score").value(), row.metric("map_best").value());
  EXPECT_EQ(candidates_per_generation(config), 32);
  EXPECT_EQ(candidates_per_generation(small_config()), 40);
}

TEST(MapRun, RefusesDescriptorsThatItsRobotDoesNotHave) {
  const TemporaryFolder scratch;
  const auto refusal = [&](const std::string& descriptor) {
    try {
      Run::start(scratch / "run", small_map_config({"search.map_elites.descriptors=[{" + descriptor + "}]"}),
                 1);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("leg=\"tail\""), testing::HasSubstr("leg = \"tail\": the robot has FL, FR, BL, BR"));
  EXPECT_THAT(refusal("quantity=\"turn\", leg=\"FL\""), testing::HasSubstr("a quantity of the whole robot"));
  EXPECT_THAT(refusal("quantity=\"joy\""), testing::HasSubstr("quantity \"joy\": expected distance, "));
  EXPECT_FALSE(std::filesystem::exists(scratch / "run"));
}

TEST(ObjectiveRun, KeepsNoArchiveAndRecordsNoPaths) {
  const TemporaryFolder scratch;
  Listener listener;
  const auto config = small_config();
  EXPECT_EQ(config.make_behaviour()->path().stride, 0);
  EXPECT_EQ(config.make_behaviour()->length(), 0u);
  Run::start(scratch / "run", config, 1).execute(listener, listener.stop);
  EXPECT_FALSE(std::filesystem::exists(scratch / "run/archive.bin"));
  EXPECT_FALSE(listener.rows.front().metric("archive"));
}

TEST(RefereedRun, TriesEachChampionInTheRefereesAndIsTheSameRunOtherwise) {
  const TemporaryFolder scratch;
  const auto folder = [&](int jobs) { return scratch / ("refereed" + std::to_string(jobs)); };
  Listener plain, refereed;
  Run::start(scratch / "plain", small_config({"engine=batch"}), 1).execute(plain, plain.stop);
  for (const int jobs : {1, 2})
    Run::start(folder(jobs), small_config({"engine=batch", "referees=[\"mujoco\", \"ode\"]"}), jobs)
        .execute(refereed, refereed.stop);
  EXPECT_EQ(champions(folder(1)), champions(folder(2)));
  EXPECT_GT(refereed.rows.front().times.referees_s, 0.0);
  EXPECT_EQ(plain.rows.front().times.referees_s, 0.0);
  const auto files = RunPaths(folder(1)).champion_files();
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const auto champion = load_champion(file);
    ASSERT_EQ(champion.referees.size(), 2u);
    for (const auto& [engine, result] : champion.referees) {
      const auto again = replay(champion.problem, champion.genome, {.engine = engine}, refereed.stop);
      EXPECT_EQ(result.distance_m, again->result.distance_m) << engine;
      EXPECT_EQ(result.steps, again->result.steps) << engine;
    }
    EXPECT_EQ(champion.referees[0].engine, "mujoco");
    const auto twin = load_champion(scratch / "plain/champions" / file.filename());
    EXPECT_TRUE(twin.referees.empty());
    EXPECT_EQ(champion.genome, twin.genome);
    EXPECT_EQ(champion.trace, twin.trace);
  }
}

TEST(RefereedRun, IsRefusedBeforeAnythingIsWrittenIfARefereeCannotSimulateTheRobot) {
  const TemporaryFolder scratch;
  auto robot = load_robot_file(small_config().robot);
  robot.self_collision = true;
  io::write_file(scratch / "robot.json", robot_file_text(robot));
  auto config = small_config({"referees=[\"batch\"]"});
  config.robot = (scratch / "robot.json").string();
  try {
    Run::start(scratch / "run", config, 1);
    ADD_FAILURE() << "accepted";
  } catch (const UserError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("referees: the batch engine knows no self-collision"))
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "run"));
}

TEST(Run, LeavesNothingBehindWhenTheRobotIsUnknown) {
  const TemporaryFolder scratch;
  auto config = small_config();
  config.robot = (scratch / "none.toml").string();
  EXPECT_THROW(Run::start(scratch / "run", config, 1), UserError);
  EXPECT_FALSE(std::filesystem::exists(scratch / "run"));
}

TEST(Run, HasNoStageThatTakesLongerThanItsGeneration) {
  // With one worker; what was spent on writing the row before belongs to the next.
  const TemporaryFolder scratch;
  Config config = small_config({"engine=batch", "trial.duration_s=0.05"});
  config.generations = 60;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  ASSERT_EQ(listener.rows.size(), 60u);
  for (const auto& row : listener.rows) {
    EXPECT_GE(row.times.files_s, 0.0);
    EXPECT_LE(row.times.files_s + row.times.search_s + row.times.decode_s, row.wall_s + 1e-3)
        << row.generation;
  }
}

/// Adds up what the rows say.
class Sums : public RunListener {
 public:
  void on_generation(const GenerationRow& row, const Progress& progress, const Config&) override {
    evaluations_ += row.evaluations;
    steps_ += row.steps;
    EXPECT_EQ(progress.evaluations, evaluations_);
    EXPECT_EQ(progress.steps, steps_);
  }

 private:
  decltype(Progress::evaluations) evaluations_ = 0;
  decltype(Progress::steps) steps_ = 0;
};

TEST(Run, CountsEvaluationsAndStepsOfAllItsGenerations) {
  const TemporaryFolder scratch;
  Sums sums;
  const std::atomic<bool> never{false};
  EXPECT_EQ(Run::start(scratch / "run", small_config({"engine=batch"}), 1).execute(sums, never),
            RunStatus::finished);
}

/// The lines without the columns that tell what is typical, as builds before there were such wrote them.
std::string without_typical(const std::string& table) {
  std::istringstream lines(table);
  std::string earlier;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column)
      if (column < 5 || column > 8) earlier += (column > 0 ? "," : "") + cell;
    earlier += "\n";
  }
  return earlier;
}

TEST(Run, GoesOnWithTheColumnsOfATableThatAnEarlierBuildBegan) {
  const TemporaryFolder scratch;
  Config config = small_config();
  config.generations = 2;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  const RunPaths paths(scratch / "run");
  const std::string earlier = without_typical(io::read_file(paths.generations));
  ASSERT_EQ(earlier.find("typical"), std::string::npos) << earlier;
  io::write_file(paths.generations, earlier);
  RunState state(config, small_problem(config));
  state.progress = load_checkpoint(paths.checkpoint, config, *state.strategy);
  state.progress.csv_bytes = earlier.size();
  state.progress.csv_digest = 0;  // they had none
  save_checkpoint(paths.checkpoint, config, state.progress, *state.strategy);

  ASSERT_EQ(Run::resume(scratch / "run", 4, 1).execute(listener, listener.stop), RunStatus::finished);
  const auto table = record::read_generations(paths.generations);
  EXPECT_EQ(table.count(), 4u);
  EXPECT_TRUE(table.typical.empty());
  EXPECT_EQ(table.best.back(), listener.rows.back().best);
}

TEST(Run, RefusesToGoOnWithATableOfOtherColumns) {
  const TemporaryFolder scratch;
  Config config = small_config();
  config.generations = 2;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  const RunPaths paths(scratch / "run");
  std::string table = io::read_file(paths.generations);
  io::write_file(paths.generations, table.replace(0, 10, "GENERATION"));
  try {
    Run::resume(scratch / "run", 3, 1);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("generations.csv:1: column 'GENERATION'"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(io::read_file(paths.generations), table) << "nothing was changed";
}

}  // namespace
}  // namespace amble::experiment
