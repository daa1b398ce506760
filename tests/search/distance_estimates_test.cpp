#include "amble/search/distance_estimates.hpp"

#ifdef AMBLE_OPENBLAS
#include <cblas.h>
#endif
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/search/samples.hpp"

namespace amble::search {
namespace distance_estimates_test {

TEST(DistanceEstimates, BoundsHoldForBehavioursOfAllShapes) {
  for (const std::size_t length : {1u, 2u, 7u, 64u, 750u, 3000u}) {
    for (const Shape shape : shapes) {
      Stream stream(1, Purpose::test, static_cast<std::uint32_t>(length), static_cast<std::uint32_t>(shape));
      const auto a = to_behaviours(random_rows(shape, 13, length, stream)),
                 b = to_behaviours(random_rows(shape, 17, length, stream));
      const DistanceEstimates estimates(a, b);
      for (std::size_t i = 0; i < a.rows(); ++i) {
        for (std::size_t j = 0; j < b.rows(); ++j) {
          const double exact = exact_squared_distance(a.row(i), b.row(j));
          const auto [lower, upper] = estimates.between(i, j);
          ASSERT_LE(lower, exact) << length << " numbers of shape " << static_cast<int>(shape);
          ASSERT_GE(upper, exact) << length << " numbers of shape " << static_cast<int>(shape);
        }
      }
    }
  }
}

TEST(DistanceEstimates, AreNarrowEnoughToTellPathsApart) {
  Stream stream(2, Purpose::test);
  const auto a = to_behaviours(random_rows(Shape::normal, 10, 1500, stream));
  const DistanceEstimates estimates(a, a);
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::size_t j = 0; j < a.rows(); ++j) {
      const auto [lower, upper] = estimates.between(i, j);
      EXPECT_LE(upper - lower, 4e-4 * std::sqrt(a.squared_norms()[i] * a.squared_norms()[j]));
    }
  }
}

TEST(DistanceEstimates, KnowNothingOnceFloatsOverflow) {
  const auto a = to_behaviours({{3e38f, 3e38f}, {-3e38f, 3e38f}});
  const DistanceEstimates estimates(a, a);
  const auto [lower, upper] = estimates.between(0, 0);
  EXPECT_EQ(lower, 0.0);
  EXPECT_TRUE(std::isinf(upper));
}

#ifdef AMBLE_OPENBLAS
TEST(DistanceEstimates, RestoreTheNumberOfThreads) {
  Stream stream(3, Purpose::test);
  const auto a = to_behaviours(random_rows(Shape::normal, 4, 10, stream));
  const int before = openblas_get_num_threads();
  openblas_set_num_threads(2);
  const int set = openblas_get_num_threads();
  const DistanceEstimates estimates(a, a);
  EXPECT_EQ(openblas_get_num_threads(), set);
  openblas_set_num_threads(before);
}
#endif

}  // namespace distance_estimates_test
}  // namespace amble::search
