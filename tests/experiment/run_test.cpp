#include "amble/experiment/run.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"
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

TEST(Run, GivesTheSameChampionsForAnyNumberOfWorkers) {
  const ScratchFolder scratch;
  std::string first;
  for (const int jobs : {1, 2, 4}) {
    const auto folder = scratch.path / std::to_string(jobs);
    Listener listener;
    EXPECT_EQ(Run::start(folder, small_config(), jobs).execute(listener, listener.stop), RunStatus::finished);
    if (first.empty()) first = champions(folder);
    EXPECT_EQ(champions(folder), first);
  }
}

TEST(Run, GoesOnAfterAnInterruptionAsIfThereHadBeenNone) {
  const ScratchFolder scratch;
  Listener whole;
  Run::start(scratch.path / "whole", small_config(), 2).execute(whole, whole.stop);
  Listener part(1);
  EXPECT_EQ(Run::start(scratch.path / "part", small_config(), 2).execute(part, part.stop),
            RunStatus::interrupted);
  Listener rest;
  EXPECT_EQ(Run::resume(scratch.path / "part", {}, 2).execute(rest, rest.stop), RunStatus::finished);
  EXPECT_EQ(champions(scratch.path / "part"), champions(scratch.path / "whole"));
  ASSERT_EQ(rest.rows.size(), 2u);
  EXPECT_EQ(rest.rows.back().best_so_far_m, whole.rows.back().best_so_far_m);
}

TEST(Run, NeverLosesItsBestDistance) {
  const ScratchFolder scratch;
  Listener listener;
  Run::start(scratch.path / "run", small_config({"generations=6"}), 2).execute(listener, listener.stop);
  for (std::size_t i = 1; i < listener.rows.size(); ++i)
    EXPECT_GE(listener.rows[i].best_m, listener.rows[i - 1].best_m)
        << "elites are carried over, and trials repeat";
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
