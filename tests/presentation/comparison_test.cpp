#include "amble/presentation/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace amble::presentation {
namespace {

TEST(Comparison, CountsEachTrialOfEachChampionLengthAndEngineOnce) {
  const auto champion = experiment::load_champion(AMBLE_SOURCE_DIR "/robots/servo/champion.json");
  CompareOptions options{.seconds = {0.1, 0.2}, .engines = {"batch", "mujoco"}};
  options.disturbance.trials = 3;
  std::vector<std::size_t> counts;
  options.on_trial = [&counts](std::size_t done, std::size_t of) {
    EXPECT_EQ(of, 2u * 2u * 2u * 3u) << "champions × lengths × engines × trials";
    counts.push_back(done);
  };
  const std::atomic<bool> stop = false;
  const auto rows = compare({{"one", champion}, {"another", champion}}, options, stop);
  ASSERT_TRUE(rows);
  ASSERT_EQ(counts.size(), 24u);
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], i + 1);
}

}  // namespace
}  // namespace amble::presentation
