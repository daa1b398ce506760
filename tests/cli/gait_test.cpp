#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;

TEST(GaitCommand, NeedsNoMoreMemoryForATrialTenTimesAsLong) {
#ifdef AMBLE_SANITIZED
  GTEST_SKIP() << "sanitizers keep freed memory, and shadows of it";
#endif
  const TemporaryFolder scratch;
  const auto run = scratch / "run";
  const auto evolved = amble({"evolve", AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml", "--set",
                              "engine=batch", "--set", "population.size=40", "--set", "trial.duration_s=2",
                              "--generations", "1", "--seed", "4", "--out", run});
  ASSERT_EQ(evolved.exit_code, 0) << evolved.err;

  // A robot that stays up, so that the longer trial is longer.
  const auto minute = amble({"gait", run, "--seconds", "60"}), ten = amble({"gait", run, "--seconds", "600"});
  ASSERT_THAT(minute.out, HasSubstr(", 60.00 s, completed\n")) << minute.err;
  ASSERT_THAT(ten.out, HasSubstr(", 600.00 s, completed\n")) << ten.err;
  // Twenty bytes for each of the 54,000 further frames would be more than this megabyte.
  EXPECT_GT(minute.peak_memory_bytes, 1e6);
  EXPECT_LT(ten.peak_memory_bytes, minute.peak_memory_bytes + 1e6);
}

}  // namespace
}  // namespace amble::tests
