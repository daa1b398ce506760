#include <gtest/gtest.h>

#include <vector>

#include "amble/record/trajectory.hpp"

namespace amble::record {
namespace {

std::vector<int> sampled(const PathSampling& sampling, int steps) {
  std::vector<int> at;
  for (int step = 1; step <= steps; ++step)
    if (sampling.at(step, steps)) at.push_back(step);
  return at;
}

TEST(PathSampling, TakesEverySecondStepFromTheFirstOrFromTheSecond) {
  EXPECT_EQ(sampled({.stride = 2, .first_step = 1}, 7), (std::vector<int>{1, 3, 5}));
  EXPECT_EQ(sampled({.stride = 2, .first_step = 2}, 7), (std::vector<int>{2, 4, 6}));
  EXPECT_EQ(sampled({.stride = 1, .first_step = 1}, 3), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(sampled({}, 3), std::vector<int>());
}

TEST(PathSampling, CountsItsSamplesAndTheyDoNotDependOnTheFirstStep) {
  for (int steps = 1; steps <= 60; ++steps)
    for (int stride = 1; stride <= 20; ++stride)
      for (int first_step = 1; first_step <= stride; ++first_step) {
        const PathSampling sampling{stride, first_step};
        const auto at = sampled(sampling, steps);
        ASSERT_EQ(static_cast<int>(at.size()), sampling.count(steps)) << steps << ' ' << stride;
        ASSERT_EQ(sampling.count(steps), steps / stride);
        for (std::size_t i = 0; i < at.size(); ++i)
          ASSERT_EQ(at[i], first_step + static_cast<int>(i) * stride);
      }
}

}  // namespace
}  // namespace amble::record
