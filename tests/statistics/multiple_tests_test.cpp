#include "amble/statistics/multiple_tests.hpp"

#include <gtest/gtest.h>

#include "amble/core/random.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

TEST(Holm, IsThatOfR) {
  ASSERT_GE(tests::oracles()["families"].size(), 20u);
  for (const auto& family : tests::oracles()["families"]) {
    const auto adjusted = holm(tests::Sample(family["p"]));
    ASSERT_EQ(adjusted.size(), family["holm"].size());
    for (std::size_t i = 0; i < adjusted.size(); ++i)
      EXPECT_TRUE(tests::is_near(adjusted[i], family["holm"][i]));
  }
  EXPECT_TRUE(holm({}).empty());
}

TEST(Holm, LiesBetweenTheValueAndBonferronisAndKeepsTheOrder) {
  Stream stream(6, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    tests::Sample p(1 + stream.below(20));
    for (double& value : p) value = stream.uniform() * stream.uniform();
    const auto adjusted = holm(p);
    for (std::size_t a = 0; a < p.size(); ++a) {
      EXPECT_GE(adjusted[a], p[a]);
      EXPECT_LE(adjusted[a], std::min(1.0, static_cast<double>(p.size()) * p[a]));
      for (std::size_t b = 0; b < p.size(); ++b) {
        if (p[a] < p[b]) {
          EXPECT_LE(adjusted[a], adjusted[b]);
        }
      }
    }
  }
}

TEST(HolmDeathTest, RefusesWhatIsNoProbability) {
  EXPECT_DEATH(holm(tests::Sample{0.5, 1.5}), "between 0 and 1");
}

}  // namespace
}  // namespace amble::statistics
