#include "amble/neat/allotment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

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

}  // namespace
}  // namespace amble::neat
