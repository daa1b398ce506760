#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "amble/physics/batch/step.hpp"

namespace amble::physics::batch {
namespace {

TEST(BatchTrigonometry, SineAndCosineAreRightToTheirStatedError) {
  constexpr int count = 16 * 4096;
  std::vector<float> angles(count), sines(count), cosines(count);
  for (int i = 0; i < count; ++i)
    angles[static_cast<std::size_t>(i)] = -100.0f + 200.0f * static_cast<float>(i) / count;
  sine_cosine(angles.data(), sines.data(), cosines.data(), count);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double angle = static_cast<double>(angles[i]);
    ASSERT_NEAR(static_cast<double>(sines[i]), std::sin(angle), 2e-7) << angle;
    ASSERT_NEAR(static_cast<double>(cosines[i]), std::cos(angle), 2e-7) << angle;
  }
}

TEST(BatchTrigonometry, ArcTangentKnowsAllQuadrants) {
  constexpr int count = 16 * 1024;
  std::vector<float> x(count), y(count), angles(count);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = -3.14 + 6.28 * static_cast<double>(i) / count,
                 length = 0.1 + static_cast<double>(i % 7);
    x[i] = static_cast<float>(length * std::cos(angle));
    y[i] = static_cast<float>(length * std::sin(angle));
  }
  x[0] = y[0] = 0.0f;
  arc_tangent(y.data(), x.data(), angles.data(), count);
  EXPECT_EQ(angles[0], 0.0f);
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_NEAR(static_cast<double>(angles[i]),
                std::atan2(static_cast<double>(y[i]), static_cast<double>(x[i])), 4e-7);
}

}  // namespace
}  // namespace amble::physics::batch
