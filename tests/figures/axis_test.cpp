#include "amble/figures/axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/figures/xml.hpp"

namespace amble::figures {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

void expect_ticks(const Ticks& ticks, const std::vector<double>& values, int decimals) {
  EXPECT_THAT(ticks.values, Pointwise(testing::DoubleNear(1e-12), values));
  EXPECT_EQ(ticks.decimals, decimals);
}

TEST(NiceTicks, AreMultiplesOfOneTwoOrFive) {
  expect_ticks(nice_ticks({0, 10}, 11), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 0);
  expect_ticks(nice_ticks({0, 10}, 10), {0, 2, 4, 6, 8, 10}, 0);
  expect_ticks(nice_ticks({0, 10}, 4), {0, 5, 10}, 0);
  expect_ticks(nice_ticks({0, 1}, 3), {0, 0.5, 1}, 1);
  expect_ticks(nice_ticks({-0.03, 0.04}, 4), {-0.02, 0, 0.02, 0.04}, 2);
  expect_ticks(nice_ticks({0, 3.3}, 5), {0, 1, 2, 3}, 0);
  expect_ticks(nice_ticks({1230, 1270}, 5), {1230, 1240, 1250, 1260, 1270}, 0);
}

TEST(NiceTicks, AreNoFinerThanAsked) {
  expect_ticks(nice_ticks({0, 1}, 9, 1.0), {0, 1}, 0);
  expect_ticks(nice_ticks({0, 12}, 9, 1.0), {0, 2, 4, 6, 8, 10, 12}, 0);
}

TEST(NiceTicks, OfAPointAreThatPoint) {
  expect_ticks(nice_ticks({3, 3}, 5), {3}, 0);
}

TEST(NiceTicks, FillEveryIntervalButNotMoreThanAsked) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 10000; ++i) {
    const double lower = stream.uniform(-100, 100);
    const double length = std::pow(10.0, stream.uniform(-4, 5));
    const int most = 2 + static_cast<int>(stream.below(12));
    const Ticks ticks = nice_ticks({lower, lower + length}, most);
    ASSERT_LE(ticks.values.size(), static_cast<std::size_t>(most));
    // The next finer step, at most 2.5 times finer, would have given too many.
    ASSERT_GE(std::floor(length / (ticks.step / 2.5)) + 1, most) << lower << " " << length << " " << most;
    for (const double tick : ticks.values) {
      ASSERT_GE(tick, lower - 1e-6 * length);
      ASSERT_LE(tick, lower + length * (1 + 1e-6));
    }
  }
}

TEST(Label, HasFixedDecimalsAndATrueMinus) {
  EXPECT_EQ(label(1.0, 1), "1.0");
  EXPECT_EQ(label(-0.5, 1), "\u22120.5");
  EXPECT_EQ(label(-0.001, 1), "0.0");
  EXPECT_EQ(label(20.0, 0), "20");
}

TEST(Scale, IsLinearEitherWay) {
  const Scale up{{0, 4}, 100, 20};
  EXPECT_DOUBLE_EQ(up(0), 100);
  EXPECT_DOUBLE_EQ(up(4), 20);
  EXPECT_DOUBLE_EQ(up(1), 80);
}

TEST(Axis, CarriesItsUnitOnceAndPlacesLabels) {
  Svg svg(200, 100, "");
  draw_x_axis(svg, Scale{{0, 1}, 10, 110}, nice_ticks({0, 1}, 3), 50, " s");
  const auto elements = tests::parse_xml(svg.finish());
  EXPECT_THAT(tests::texts(elements), ElementsAre("0", "0.5", "1.0 s"));
  const auto labels = tests::with_class(elements, "tick");
  EXPECT_EQ(labels[1].number("x"), 60);
}

TEST(Spread, MovesApartOnlyWhatIsTooClose) {
  std::vector<double> positions{100, 20, 102};
  spread(positions, 10);
  EXPECT_THAT(positions, ElementsAre(DoubleNear(96, 1e-6), DoubleNear(20, 1e-6), DoubleNear(106, 1e-6)));
}

TEST(Spread, KeepsTheOrderOfManyLabels) {
  std::vector<double> positions{5, 5, 5, 5};
  spread(positions, 10);
  for (std::size_t i = 1; i < positions.size(); ++i) EXPECT_GE(positions[i] - positions[i - 1], 10 - 1e-3);
}

}  // namespace
}  // namespace amble::figures
