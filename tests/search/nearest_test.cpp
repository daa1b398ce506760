#include "amble/search/novelty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/search/samples.hpp"

namespace amble::search {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds that hold, but are otherwise as odd as another CPU or library could make them, and odder.
Bounds some_bounds(double exact, Stream& stream) {
  switch (stream.below(5)) {
    case 0:
      return {exact, exact};
    case 1:
      return {-infinity, infinity};
    case 2:
      return {exact, infinity};
    case 3:
      return {exact - stream.uniform(0.0, 1e-9), exact + stream.uniform(0.0, 1e-9)};
    default:
      return {exact - stream.uniform() * exact, exact + stream.uniform() * exact};
  }
}

TEST(Nearest, IsTheSameToTheBitWhateverTheBoundsAreAsLongAsTheyHold) {
  for (std::uint32_t round = 0; round < 2000; ++round) {
    Stream stream(1, Purpose::test, 0, round);
    const Shape shape = shapes[stream.below(shapes.size())];
    const auto from = random_row(shape, 9, stream);
    const auto rows = random_rows(shape, stream.below(30), 9, stream);
    const std::size_t count = 1 + stream.below(20);
    std::vector<Reference> references;
    std::vector<double> expected;
    for (const auto& row : rows) {
      expected.push_back(exact_squared_distance(from, row));
      references.push_back({some_bounds(expected.back(), stream), row});
    }
    std::ranges::sort(expected);
    expected.resize(std::min(expected.size(), count));
    ASSERT_EQ(nearest_squared_distances(from, references, count), expected) << round;
  }
}

TEST(Nearest, DoesNotMeasureWhoIsCertainlyFarther) {
  // Computing a distance that is not needed would fail: behaviours of another length.
  const std::vector<float> from{0.0f}, near{1.0f}, unmeasurable{5.0f, 5.0f};
  const std::vector<Reference> references{
      {{2.0, 9.0}, unmeasurable}, {{0.5, 1.5}, near}, {{1.6, 1.7}, unmeasurable}};
  EXPECT_THAT(nearest_squared_distances(from, references, 1), testing::ElementsAre(1.0));
}

TEST(Nearest, OfNoReferencesAreNone) {
  const std::vector<float> from{0.0f};
  EXPECT_TRUE(nearest_squared_distances(from, {}, 3).empty());
}

}  // namespace
}  // namespace amble::search
