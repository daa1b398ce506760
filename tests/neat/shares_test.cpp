#include "amble/neat/shares.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "amble/core/random.hpp"

namespace amble::neat {
namespace {

std::vector<int> allot(const std::vector<double>& shares, int total, std::size_t kept = 0) {
  return allot_places(shares, total, kept);
}

TEST(Allotment, GivesTheLeftoverPlacesToTheLargestRemainders) {
  // 10 places for 5 : 3 : 1 are 5.56, 3.33, 1.11; the one place left goes to .56.
  EXPECT_EQ(allot({5, 3, 1}, 10), (std::vector<int>{6, 3, 1}));
  // 4 places for three equal shares: the first of equal remainders gets the one left.
  EXPECT_EQ(allot({1, 1, 1}, 4), (std::vector<int>{2, 1, 1}));
}

TEST(Allotment, TreatsAllZeroSharesAsEqual) {
  EXPECT_EQ(allot({0, 0, 0}, 9), (std::vector<int>{3, 3, 3}));
}

TEST(Allotment, GivesNothingForNothing) {
  EXPECT_EQ(allot({2, 0, 2}, 8), (std::vector<int>{4, 0, 4}));
}

TEST(Allotment, KeepsTheNamedSpeciesAlive) {
  EXPECT_EQ(allot({8, 0, 2}, 10, 1), (std::vector<int>{7, 1, 2}));
  EXPECT_EQ(allot({1e300, 1e-300}, 5, 1), (std::vector<int>{4, 1}));
}

TEST(Allotment, LetsAnySpeciesGoIfNoneIsKept) {
  EXPECT_EQ(allot_places(std::vector<double>{8, 0, 2}, 10, std::nullopt), (std::vector<int>{8, 0, 2}));
  EXPECT_EQ(allot_places(std::vector<double>{0, 1}, 5, std::nullopt), (std::vector<int>{0, 5}));
}

TEST(Allotment, SurvivesSharesAtTheLimitsOfDouble) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(allot({huge, huge, huge, huge}, 8), (std::vector<int>{2, 2, 2, 2}));
  EXPECT_EQ(allot({tiny, tiny}, 8), (std::vector<int>{4, 4}));
  EXPECT_EQ(allot({huge, tiny}, 8), (std::vector<int>{8, 0}));
}

TEST(Allotment, AddsUpAndStaysWithinOnePlaceOfProportionInRandomCases) {
  Stream stream(11, Purpose::test);
  for (int round = 0; round < 20000; ++round) {
    std::vector<double> shares(1 + stream.below(40));
    const double spread = stream.uniform(0, 600);
    for (double& share : shares)
      share = stream.chance(0.2) ? 0.0 : std::pow(10.0, stream.uniform(-spread / 2, spread / 2));
    const int total = 1 + static_cast<int>(stream.below(400));
    const auto kept = static_cast<std::size_t>(stream.below(static_cast<std::uint32_t>(shares.size())));
    const auto places = allot_places(shares, total, kept);

    ASSERT_EQ(std::accumulate(places.begin(), places.end(), 0), total);
    ASSERT_GE(places[kept], 1);
    const long double sum = std::accumulate(shares.begin(), shares.end(), 0.0L);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      ASSERT_GE(places[i], 0);
      const long double exact =
          sum == 0 ? static_cast<long double>(total) / static_cast<long double>(shares.size())
                   : shares[i] / sum * total;
      // The place for `kept` may come on top of, or off, the rounding.
      ASSERT_LT(std::abs(static_cast<double>(places[i] - exact)), 2.0 + 1e-9);
      if (i != kept && places[kept] > 1) {
        ASSERT_LT(std::abs(static_cast<double>(places[i] - exact)), 1.0 + 1e-9);
      }
    }
  }
}

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
