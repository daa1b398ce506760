#include "amble/core/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "amble/core/hash.hpp"
#include "amble/core/random.hpp"

namespace amble::portable {
namespace {

/// Two units in the last place of `value`.
double close(double value) {
  return 2.0 * std::abs(value) * std::numeric_limits<double>::epsilon();
}

TEST(Log, IsThatOfTheCLibraryButForLastPlaces) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(0.5 + stream.uniform(), static_cast<int>(stream.below(2000)) - 1000);
    EXPECT_NEAR(log(x), std::log(x), close(std::log(x))) << x;
    const double near_one = 1.0 + (stream.uniform() - 0.5) * 1e-3;
    EXPECT_NEAR(log(near_one), std::log(near_one), close(std::log(near_one))) << near_one;
  }
  EXPECT_EQ(log(1.0), 0.0);
}

TEST(Exp, IsThatOfTheCLibraryButForLastPlaces) {
  Stream stream(2, Purpose::test);
  for (int i = 0; i < 20000; ++i) {
    const double x = stream.uniform(-700.0, 700.0), small = stream.uniform(-1.0, 1.0);
    EXPECT_NEAR(exp(x), std::exp(x), close(std::exp(x))) << x;
    EXPECT_NEAR(exp(small), std::exp(small), close(std::exp(small))) << small;
  }
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(exp(-1e300), 0.0);
  EXPECT_EQ(exp(1e300), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(exp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Power, IsTheProductOfSoManyFactors) {
  EXPECT_EQ(power(0.3, 0), 1.0);
  EXPECT_EQ(power(-2.0, 11), -2048.0);
  EXPECT_NEAR(power(0.999, 1000), std::pow(0.999, 1000.0), 1e-13);
  EXPECT_EQ(power(0.5, 2'000'000'000), 0.0);
}

TEST(SineAndCosine, AreThoseOfTheCLibraryButForLastPlaces) {
  Stream stream(3, Purpose::test);
  for (int i = 0; i < 20000; ++i) {
    const double turns = stream.uniform(-2.0, 2.0), angle = 2.0 * std::numbers::pi * turns;
    // The angle of the C library's is itself rounded.
    const double rounding = std::abs(angle) * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(of_turns(turns).sine, std::sin(angle), close(1.0) + rounding) << turns;
    EXPECT_NEAR(of_turns(turns).cosine, std::cos(angle), close(1.0) + rounding) << turns;
  }
}

TEST(SineAndCosine, AreExactAtQuarters) {
  const double sines[] = {0.0, 1.0, 0.0, -1.0};
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SineCosine at = of_turns(quarter / 4.0);
    EXPECT_EQ(at.sine, sines[(quarter + 8) % 4]) << quarter;
    EXPECT_EQ(at.cosine, sines[(quarter + 9) % 4]) << quarter;
  }
}

/// All bits of many results, which are the same on every processor.
TEST(ElementaryFunctions, HaveTheseBitsEverywhere) {
  Stream stream(4, Purpose::test);
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i) {
    const double x = stream.uniform();
    const SineCosine turned = of_turns(x);
    values.insert(values.end(), {log(1.0 - x), exp(4.0 * x - 2.0), power(x, 7), turned.sine, turned.cosine});
  }
  EXPECT_EQ(hex(hash_span(std::span<const double>(values))), "a1250b89210ae124");
}

}  // namespace
}  // namespace amble::portable
