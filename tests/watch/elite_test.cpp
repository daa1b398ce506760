#include "amble/watch/elite.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/watch/watcher.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::watch {
namespace {

using experiment::Listener;
using experiment::Run;
using experiment::RunPaths;

class Elite : public testing::Test {
 protected:
  void make(const experiment::Config& config) {
    Listener listener;
    Run::start(scratch_ / "run", config, 1).execute(listener, listener.stop);
  }

  const test::TemporaryFolder scratch_;
  const RunPaths paths_{scratch_ / "run"};
};

TEST_F(Elite, OfAFilledCellIsTheChampionThatTheRepertoireGives) {
  make(experiment::small_map_config());
  const auto map = experiment::load_repertoire(paths_);
  const std::uint32_t cell = map.elites[map.elites.size() - 1].cell;
  const std::atomic<bool> stop = false;
  const auto expected = experiment::elite_champion(map, cell, 1, stop);
  ASSERT_TRUE(expected);
  const std::string text = elite_text(paths_, cell);
  EXPECT_EQ(text, experiment::champion_text(*expected));
  const Watcher watcher(scratch_ / "run");
  EXPECT_EQ(watcher.elite(".", cell), text);
  EXPECT_EQ(watcher.elite("other", cell), "");
}

TEST_F(Elite, OfAnEmptyCellAndOfOneThatIsNotThereIsNothing) {
  make(experiment::small_map_config());
  const auto map = experiment::load_repertoire(paths_);
  std::uint32_t empty = 0;
  while (map.elites.in(empty) != search::Elites::none) ++empty;
  ASSERT_LT(empty, map.elites.cells());
  EXPECT_EQ(elite_text(paths_, empty), "");
  EXPECT_EQ(elite_text(paths_, map.elites.cells()), "");
}

TEST_F(Elite, OfARunThatFillsNoMapIsNothing) {
  EXPECT_EQ(elite_text(paths_, 0), "");
  make(experiment::small_config({"engine=batch"}));
  EXPECT_EQ(elite_text(paths_, 0), "");
}

}  // namespace
}  // namespace amble::watch
