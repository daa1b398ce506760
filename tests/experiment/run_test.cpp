#include "amble/experiment/run.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"
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

/// The archive of a run under novelty search; "" of another.
std::string archive(const std::filesystem::path& folder) {
  const auto path = RunPaths(folder).archive;
  return std::filesystem::exists(path) ? io::read_file(path) : "";
}

class EachSearch : public testing::TestWithParam<search::Kind> {
 protected:
  Config config() const {
    return GetParam() == search::Kind::novelty ? small_novelty_config() : small_config();
  }
};

INSTANTIATE_TEST_SUITE_P(Run, EachSearch, testing::Values(search::Kind::objective, search::Kind::novelty),
                         [](const auto& kind) {
                           return std::string(search::kind_names[static_cast<std::size_t>(kind.param)]);
                         });

TEST_P(EachSearch, GivesTheSameChampionsAndArchiveForAnyNumberOfWorkers) {
  const ScratchFolder scratch;
  std::string first, first_archive;
  for (const int jobs : {1, 2, 4}) {
    const auto folder = scratch.path / std::to_string(jobs);
    Listener listener;
    EXPECT_EQ(Run::start(folder, config(), jobs).execute(listener, listener.stop), RunStatus::finished);
    if (first.empty()) first = champions(folder), first_archive = archive(folder);
    EXPECT_EQ(champions(folder), first);
    EXPECT_EQ(archive(folder), first_archive);
  }
}

TEST_P(EachSearch, GoesOnAfterAnInterruptionAsIfThereHadBeenNone) {
  const ScratchFolder scratch;
  Listener whole;
  Run::start(scratch.path / "whole", config(), 2).execute(whole, whole.stop);
  Listener part(1);
  EXPECT_EQ(Run::start(scratch.path / "part", config(), 2).execute(part, part.stop), RunStatus::interrupted);
  Listener rest;
  EXPECT_EQ(Run::resume(scratch.path / "part", {}, 2).execute(rest, rest.stop), RunStatus::finished);
  EXPECT_EQ(champions(scratch.path / "part"), champions(scratch.path / "whole"));
  EXPECT_EQ(archive(scratch.path / "part"), archive(scratch.path / "whole"));
  ASSERT_EQ(rest.rows.size(), 2u);
  EXPECT_EQ(rest.rows.back().best_so_far_m, whole.rows.back().best_so_far_m);
}

TEST_P(EachSearch, NeverLosesItsBestDistance) {
  const ScratchFolder scratch;
  Listener listener;
  auto longer = config();
  longer.generations = 6;
  Run::start(scratch.path / "run", longer, 2).execute(listener, listener.stop);
  for (std::size_t i = 1; i < listener.rows.size(); ++i)
    EXPECT_GE(listener.rows[i].best_m, listener.rows[i - 1].best_m)
        << "elites are carried over, and trials repeat";
}

TEST(NoveltyRun, FillsItsArchiveAndReportsIt) {
  const ScratchFolder scratch;
  Listener listener;
  const auto config = small_novelty_config();
  Run::start(scratch.path / "run", config, 2).execute(listener, listener.stop);
  ASSERT_EQ(listener.rows.size(), 3u);
  std::size_t before = 0;
  for (const auto& row : listener.rows) {
    ASSERT_TRUE(row.novelty);
    EXPECT_GT(row.novelty->archive_members, before);
    EXPECT_GT(row.novelty->best_novelty, row.novelty->threshold);
    before = row.novelty->archive_members;
  }
  EXPECT_EQ(config.behaviour_length(), 100u);
  EXPECT_EQ(archive(scratch.path / "run").size(), 16 + before * (100 * 4 + 8));
}

TEST(NoveltyRun, CutsAnArchiveBackThatIsAheadOfItsCheckpoint) {
  const ScratchFolder scratch;
  Listener whole, part(1), rest;
  Run::start(scratch.path / "whole", small_novelty_config(), 1).execute(whole, whole.stop);
  Run::start(scratch.path / "part", small_novelty_config(), 1).execute(part, part.stop);
  const RunPaths paths(scratch.path / "part");
  io::write_file(paths.archive, io::read_file(paths.archive) + std::string(1000, 'x'));
  io::write_file(paths.generations, io::read_file(paths.generations) + "1,2,3");
  Run::resume(scratch.path / "part", {}, 1).execute(rest, rest.stop);
  EXPECT_EQ(archive(scratch.path / "part"), archive(scratch.path / "whole"));
  EXPECT_EQ(champions(scratch.path / "part"), champions(scratch.path / "whole"));
}

TEST(ObjectiveRun, KeepsNoArchiveAndRecordsNoPaths) {
  const ScratchFolder scratch;
  Listener listener;
  const auto config = small_config();
  EXPECT_EQ(config.search.path_stride(), 0);
  EXPECT_EQ(config.behaviour_length(), 0u);
  Run::start(scratch.path / "run", config, 1).execute(listener, listener.stop);
  EXPECT_FALSE(std::filesystem::exists(RunPaths(scratch.path / "run").archive));
  EXPECT_FALSE(listener.rows.front().novelty);
}

TEST(RefereedRun, TriesEachChampionInTheRefereesAndIsTheSameRunOtherwise) {
  const ScratchFolder scratch;
  Listener plain, refereed;
  Run::start(scratch.path / "plain", small_config(), 1).execute(plain, plain.stop);
  Run::start(scratch.path / "refereed", small_config({"referees=[\"mujoco\"]"}), 2)
      .execute(refereed, refereed.stop);
  const auto files = RunPaths(scratch.path / "refereed").champion_files();
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const auto champion = load_champion(file);
    ASSERT_EQ(champion.referees.size(), 1u);
    EXPECT_EQ(champion.referees[0].engine, "mujoco");
    const auto again = replay(champion.problem, champion.genome, {.engine = "mujoco"}, refereed.stop);
    EXPECT_EQ(champion.referees[0].result.distance_m, again->result.distance_m);
    EXPECT_EQ(champion.referees[0].result.steps, again->result.steps);
    const auto twin = load_champion(scratch.path / "plain/champions" / file.filename());
    EXPECT_TRUE(twin.referees.empty());
    EXPECT_EQ(champion.genome, twin.genome);
    EXPECT_EQ(champion.trace, twin.trace);
  }
}

TEST(Run, LeavesNothingBehindWhenTheRobotIsUnknown) {
  const ScratchFolder scratch;
  auto config = small_config();
  config.robot = (scratch.path / "none.toml").string();
  EXPECT_THROW(Run::start(scratch.path / "run", config, 1), UserError);
  EXPECT_FALSE(std::filesystem::exists(scratch.path / "run"));
}

}  // namespace
}  // namespace amble::experiment
