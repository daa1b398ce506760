#include "amble/search/behaviours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/search/samples.hpp"

namespace amble::search {
namespace {

TEST(Behaviours, KeepRowsAndTheirNorms) {
  const auto behaviours = to_behaviours({{3.0f, 4.0f}, {0.0f, -0.5f}});
  ASSERT_EQ(behaviours.rows(), 2u);
  EXPECT_EQ(behaviours.row(1)[1], -0.5f);
  EXPECT_EQ(behaviours.squared_norms()[0], 25.0);
  EXPECT_EQ(behaviours.squared_norms()[1], 0.25);
}

TEST(Behaviours, NeverMoveAsTheyGrow) {
  Behaviours behaviours(2, 1000);
  const float* const before = behaviours.data();
  for (int i = 0; i < 1000; ++i) behaviours.append(std::vector<float>{1.0f, 2.0f});
  EXPECT_EQ(behaviours.data(), before);
}

TEST(BehavioursDeathTest, TakeNothingButFiniteRowsOfTheirLengthUpToTheirCapacity) {
  Behaviours behaviours(2, 1);
  EXPECT_DEATH(behaviours.append(std::vector<float>{1.0f}), "one length");
  EXPECT_DEATH(behaviours.append(std::vector<float>{1.0f, std::numeric_limits<float>::infinity()}), "finite");
  EXPECT_DEATH(behaviours.append(std::vector<float>{std::numeric_limits<float>::quiet_NaN(), 0.0f}),
               "finite");
  behaviours.append(std::vector<float>{1.0f, 2.0f});
  EXPECT_DEATH(behaviours.append(std::vector<float>{1.0f, 2.0f}), "never move");
}

TEST(ExactSquaredDistance, EqualsThePlainSumForEveryLength) {
  for (std::size_t length = 1; length < 40; ++length) {
    Stream stream(1, Purpose::test, 0, static_cast<std::uint32_t>(length));
    const auto rows = random_rows(Shape::small_whole_numbers, 2, length, stream);
    double sum = 0.0;
    for (std::size_t i = 0; i < length; ++i)
      sum += rows[0][i] == rows[1][i] ? 0.0 : std::abs(rows[0][i] - rows[1][i]) == 1.0f ? 1.0 : 4.0;
    EXPECT_EQ(exact_squared_distance(rows[0], rows[1]), sum) << length;
  }
}

TEST(ExactSquaredDistance, IsTheSameBothWaysAndZeroToItself) {
  Stream stream(2, Purpose::test);
  for (const Shape shape : shapes) {
    const auto rows = random_rows(shape, 2, 123, stream);
    EXPECT_EQ(exact_squared_distance(rows[0], rows[1]), exact_squared_distance(rows[1], rows[0]));
    EXPECT_EQ(exact_squared_distance(rows[0], rows[0]), 0.0);
  }
}

TEST(ExactSquaredDistance, HasKnownBits) {
  Stream stream(3, Purpose::test);
  const auto rows = random_rows(Shape::normal, 2, 1501, stream);
  EXPECT_EQ(exact_squared_distance(rows[0], rows[1]), 0x1.7b30585499c51p+11);
}

}  // namespace
}  // namespace amble::search
