#include "amble/neat/roulette.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace amble::neat {
namespace {

std::vector<int> draws(const std::vector<double>& weights, int count) {
  Stream stream(5, Purpose::test);
  std::vector<int> hits(weights.size());
  for (int i = 0; i < count; ++i) ++hits[roulette(weights, stream)];
  return hits;
}

TEST(Roulette, DrawsInProportion) {
  const auto hits = draws({1, 0, 3, 4}, 80000);
  EXPECT_EQ(hits[1], 0);
  EXPECT_NEAR(hits[0], 10000, 5 * std::sqrt(80000 * 0.125 * 0.875));
  EXPECT_NEAR(hits[2], 30000, 5 * std::sqrt(80000 * 0.375 * 0.625));
  EXPECT_NEAR(hits[3], 40000, 5 * std::sqrt(80000 * 0.25));
}

TEST(Roulette, IsUniformIfAllWeightsAreZero) {
  for (const int hits : draws({0, 0, 0, 0}, 40000)) EXPECT_NEAR(hits, 10000, 5 * std::sqrt(7500.0));
}

TEST(Roulette, SurvivesWeightsAtTheLimitsOfDouble) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  for (const int hits : draws({huge, huge}, 10000)) EXPECT_NEAR(hits, 5000, 250);
  for (const int hits : draws({tiny, tiny}, 10000)) EXPECT_NEAR(hits, 5000, 250);
  EXPECT_EQ(draws({tiny, huge, 0}, 1000), (std::vector<int>{0, 1000, 0}));
}

TEST(Roulette, TakesOneDrawWhateverTheWeights) {
  for (const auto& weights :
       {std::vector<double>{1}, std::vector<double>{0, 0}, std::vector<double>{1, 2, 3}}) {
    Stream stream(6, Purpose::test), twin(6, Purpose::test);
    roulette(weights, stream);
    twin.uniform();
    EXPECT_EQ(stream.next_u64(), twin.next_u64());
  }
}

}  // namespace
}  // namespace amble::neat
