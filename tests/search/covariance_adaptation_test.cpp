#include "amble/search/covariance_adaptation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"

namespace amble::search {
namespace {

using Function = double (*)(std::span<const double>);

double sphere(std::span<const double> x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

/// Axes between 1 and 1000: with steps of the same length in all directions this takes a hundred thousand.
double ellipsoid(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += std::pow(1e6, static_cast<double>(i) / static_cast<double>(x.size() - 1)) * x[i] * x[i];
  return sum;
}

double rosenbrock(std::span<const double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    sum += 100.0 * std::pow(x[i] * x[i] - x[i + 1], 2) + std::pow(x[i] - 1.0, 2);
  return sum;
}

/// One round: samples, ranks, updates. Returns the smallest value.
double step(CovarianceAdaptation& search, Function function, int candidates, std::uint32_t round,
            std::uint64_t seed) {
  std::vector<std::vector<double>> points;
  for (int i = 0; i < candidates; ++i) {
    Stream stream(seed, Purpose::test, round, static_cast<std::uint32_t>(i));
    std::vector<double> normal(search.mean().size());
    for (double& number : normal) number = stream.normal();
    points.push_back(search.sample(normal));
  }
  std::ranges::stable_sort(points, {}, [&](const auto& point) { return function(point); });
  search.update(points);
  return function(points.front());
}

/// Evaluations until a value is below 1e-9, the median of eleven seeds.
int evaluations_needed(Function function, double start, double first_step) {
  constexpr int dimensions = 10, candidates = 10;
  std::vector<int> counts;
  for (std::uint64_t seed = 1; seed <= 11; ++seed) {
    CovarianceAdaptation search(std::vector<double>(dimensions, start), first_step, candidates);
    int rounds = 0;
    while (rounds < 5000 &&
           step(search, function, candidates, static_cast<std::uint32_t>(rounds), seed) > 1e-9)
      ++rounds;
    counts.push_back(candidates * (rounds + 1));
  }
  std::ranges::nth_element(counts, counts.begin() + 5);
  return counts[5];
}

// The ranges are what pycma 4.4 (CMA_active off, popsize 10) needs from the same starts in 51 seeds: its
// quartiles, a tenth wider.
TEST(CovarianceAdaptation, MinimisesWhatPycmaDoesInAsManyEvaluations) {
  EXPECT_THAT(evaluations_needed(sphere, 1.0, 0.5), testing::AllOf(testing::Ge(1270), testing::Le(1680)));
  EXPECT_THAT(evaluations_needed(ellipsoid, 1.0, 0.5), testing::AllOf(testing::Ge(5050), testing::Le(6450)));
  EXPECT_THAT(evaluations_needed(rosenbrock, 0.1, 0.1), testing::AllOf(testing::Ge(4990), testing::Le(6630)));
}

TEST(CovarianceAdaptation, LearnsTheShapeOfALandscapeSoThatItsAxesAreTheInverse) {
  CovarianceAdaptation search({1.0, 1.0}, 0.5, 8);
  for (std::uint32_t round = 0; round < 60; ++round)
    step(
        search, [](std::span<const double> x) { return x[0] * x[0] + 1e4 * x[1] * x[1]; }, 8, round, 3);
  // Axes of 1 and 1/100.
  EXPECT_THAT(search.widest() / search.narrowest(), testing::AllOf(testing::Gt(30.0), testing::Lt(300.0)));
}

TEST(CovarianceAdaptation, SamplesItsMeanForNothingAndItsStepForOne) {
  const CovarianceAdaptation search({1.0, 2.0, 3.0}, 0.5, 8);
  EXPECT_EQ(search.sample(std::vector{0.0, 0.0, 0.0}), (std::vector{1.0, 2.0, 3.0}));
  EXPECT_EQ(search.sample(std::vector{0.0, 1.0, 0.0}), (std::vector{1.0, 2.5, 3.0}));
  EXPECT_EQ(search.parents(), 4);
}

TEST(CovarianceAdaptation, TakesLongerStepsWhileItGoesOneWayAndShorterOnesAroundAMinimum) {
  CovarianceAdaptation far({1000.0, 1000.0, 1000.0}, 0.1, 8), near({0.0, 0.0, 0.0}, 0.1, 8);
  for (std::uint32_t round = 0; round < 10; ++round) {
    step(far, sphere, 8, round, 1);
    step(near, sphere, 8, round, 1);
  }
  EXPECT_GT(far.step(), 0.2);
  EXPECT_LT(near.step(), 0.1);
}

TEST(CovarianceAdaptation, GoesOnToTheBitFromWhatItSaved) {
  CovarianceAdaptation search({1.0, 1.0, 1.0, 1.0}, 0.5, 8), other({0.0, 0.0, 0.0, 0.0}, 1.0, 8);
  for (std::uint32_t round = 0; round < 5; ++round) step(search, rosenbrock, 8, round, 2);
  io::BinaryWriter writer;
  search.save(writer);
  io::BinaryReader reader(writer.bytes(), "state");
  other.load(reader);
  for (std::uint32_t round = 5; round < 10; ++round) {
    step(search, rosenbrock, 8, round, 2);
    step(other, rosenbrock, 8, round, 2);
  }
  EXPECT_EQ(search.mean(), other.mean());
  EXPECT_EQ(search.step(), other.step());

  CovarianceAdaptation smaller({1.0, 1.0}, 0.5, 8);
  io::BinaryReader again(writer.bytes(), "state");
  EXPECT_THROW(smaller.load(again), UserError);
}

TEST(CovarianceAdaptation, SaysWhenNothingMoreCanBeSampled) {
  CovarianceAdaptation search({0.0, 0.0}, 1.0, 4);
  // All points on a line, again and again: the other direction shrinks until rounding has taken it.
  for (int round = 0; round < 100'000 && search.sound(); ++round) {
    const double x = search.mean()[0] + search.step();
    search.update(std::vector<std::vector<double>>{{x, search.mean()[1]}, {x, search.mean()[1]}});
  }
  EXPECT_FALSE(search.sound());
}

}  // namespace
}  // namespace amble::search
