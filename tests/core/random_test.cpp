#include "amble/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace amble {
namespace {

TEST(Stream, MatchesThePublishedPhiloxVector) {
  // Known answer of Random123 (kat_vectors): philox4x32-10, zero counter and zero key.
  Stream stream(0, Purpose::test, 0, 0);
  EXPECT_EQ(stream.next_u32(), 0x6627e8d5u);
  EXPECT_EQ(stream.next_u32(), 0xe169c58du);
  EXPECT_EQ(stream.next_u32(), 0xbc57ac4cu);
  EXPECT_EQ(stream.next_u32(), 0x9b00dbd8u);
}

TEST(Stream, DependsOnEachPartOfItsKeyAndOnNothingElse) {
  const auto first = [](Stream stream) { return stream.next_u64(); };
  const auto base = first(Stream(7, Purpose::reproduction, 3, 5));
  EXPECT_EQ(base, first(Stream(7, Purpose::reproduction, 3, 5)));
  EXPECT_NE(base, first(Stream(8, Purpose::reproduction, 3, 5)));
  EXPECT_NE(base, first(Stream(7 | 1ull << 40, Purpose::reproduction, 3, 5)));
  EXPECT_NE(base, first(Stream(7, Purpose::speciation, 3, 5)));
  EXPECT_NE(base, first(Stream(7, Purpose::reproduction, 4, 5)));
  EXPECT_NE(base, first(Stream(7, Purpose::reproduction, 3, 6)));
}

TEST(Stream, UniformStaysInItsRangeWithTheRightMoments) {
  Stream stream(1, Purpose::test);
  const int n = 200000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform(-2.0, 4.0);
    ASSERT_GE(u, -2.0);
    ASSERT_LT(u, 4.0);
    sum += u;
    squares += u * u;
  }
  const double mean = sum / n;
  EXPECT_NEAR(mean, 1.0, 5 * std::sqrt(3.0 / n));
  EXPECT_NEAR(squares / n - mean * mean, 3.0, 0.05);
}

TEST(Stream, BelowIsUniformForACountThatDoesNotDivideTwoToThe32) {
  Stream stream(2, Purpose::test);
  std::array<int, 7> counts{};
  const int n = 140000;
  for (int i = 0; i < n; ++i) ++counts[stream.below(7)];
  double chi_square = 0.0;
  for (const int count : counts) chi_square += std::pow(count - n / 7.0, 2) / (n / 7.0);
  EXPECT_LT(chi_square, 22.5);  // 0.1 % point with 6 degrees of freedom
}

TEST(Stream, NormalHasUnitVarianceAndTheRightTails) {
  Stream stream(3, Purpose::test);
  const int n = 200000;
  double sum = 0.0, squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < n; ++i) {
    const double z = stream.normal();
    sum += z;
    squares += z * z;
    beyond_two += std::abs(z) > 2.0;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.012);
  EXPECT_NEAR(squares / n, 1.0, 0.015);
  EXPECT_NEAR(beyond_two / static_cast<double>(n), 0.0455, 0.0025);
}

TEST(Stream, ChanceZeroNeverAndChanceOneAlways) {
  Stream stream(4, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(stream.chance(0.0));
    EXPECT_TRUE(stream.chance(1.0));
  }
}

}  // namespace
}  // namespace amble
