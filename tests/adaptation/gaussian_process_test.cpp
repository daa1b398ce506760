#include "amble/adaptation/gaussian_process.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "amble/core/random.hpp"

namespace amble::adaptation {
namespace {

using Point = std::vector<double>;

/// The kernel by its formula.
double matern(const Point& a, const Point& b, double length_scale) {
  double squared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) squared += std::pow(a[i] - b[i], 2);
  const double d = std::sqrt(squared);
  return (1.0 + std::sqrt(5.0) * d / length_scale + 5.0 * d * d / (3.0 * length_scale * length_scale)) *
         std::exp(-std::sqrt(5.0) * d / length_scale);
}

TEST(GaussianProcess, IsTheStandardNormalDistributionWithoutObservations) {
  const GaussianProcess process(2, 0.4, 0.001);
  EXPECT_EQ(process.predict(Point{0.3, 0.9}).mean, 0.0);
  EXPECT_EQ(process.predict(Point{0.3, 0.9}).variance, 1.0);
}

TEST(GaussianProcess, WithOneObservationIsTheClosedForm) {
  const Point at{0.2, 0.7};
  GaussianProcess process(2, 0.4, 0.1);
  process.observe(at, 3.0);
  for (const Point& point : {at, Point{0.3, 0.6}, Point{0.9, 0.0}}) {
    const double k = matern(at, point, 0.4);
    EXPECT_NEAR(process.predict(point).mean, 3.0 * k / 1.1, 1e-14);
    EXPECT_NEAR(process.predict(point).variance, 1.0 - k * k / 1.1, 1e-14);
  }
}

TEST(GaussianProcess, TakesTheChordWhereADimensionIsACircle) {
  GaussianProcess process(2, 0.4, 0.1, {0.0, 1.0});
  process.observe(Point{0.2, 0.05}, 3.0);
  const double chord = std::sin(0.1 * std::numbers::pi) / std::numbers::pi;  // of a tenth of the turn
  EXPECT_NEAR(process.predict(Point{0.3, 0.95}).mean, 3.0 * matern({0.2, chord}, {0.3, 0.0}, 0.4) / 1.1,
              1e-14);
  EXPECT_NEAR(process.predict(Point{0.2, 0.55}).mean,
              3.0 * matern({0.0, 1.0 / std::numbers::pi}, {0.0, 0.0}, 0.4) / 1.1, 1e-14)
      << "the diameter";
  EXPECT_NEAR(process.predict(Point{0.95, 0.05}).mean, 3.0 * matern({0.2, 0.05}, {0.95, 0.05}, 0.4) / 1.1,
              1e-14);
}

/// By the way round a kernel of these points would have eigenvalues below 0.
TEST(GaussianProcess, KnowsNothingForSureOfACircleThatItHasSeenAFewPointsOf) {
  for (const std::size_t points : {4u, 8u, 12u, 20u}) {
    GaussianProcess process(1, 0.4, 0.001, {1.0});
    for (std::size_t i = 0; i < points; ++i) {
      const double place = static_cast<double>(i) / static_cast<double>(points);
      process.observe(Point{place}, std::sin(4.0 * std::numbers::pi * place));
      EXPECT_NEAR(process.predict(Point{place}).mean, std::sin(4.0 * std::numbers::pi * place), 0.05);
    }
    EXPECT_GT(process.predict(Point{0.5 / static_cast<double>(points)}).variance, 0.0) << points;
  }
}

TEST(GaussianProcess, WithTwoObservationsIsTheClosedForm) {
  const Point a{0.1}, b{0.4}, x{0.3};
  GaussianProcess process(1, 0.5, 0.05);
  process.observe(a, 1.0);
  process.observe(b, -2.0);
  const double c = matern(a, b, 0.5), v = 1.05, determinant = v * v - c * c;
  const double ka = matern(a, x, 0.5), kb = matern(b, x, 0.5);
  EXPECT_NEAR(process.predict(x).mean, (ka * (v * 1.0 - c * -2.0) + kb * (v * -2.0 - c * 1.0)) / determinant,
              1e-13);
  EXPECT_NEAR(process.predict(x).variance,
              1.0 - (ka * (v * ka - c * kb) + kb * (v * kb - c * ka)) / determinant, 1e-13);
}

/// Solves A x = b by Gauss–Jordan elimination with pivots.
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i; r < n; ++r)
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == i) continue;
      const double factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < n; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) b[i] /= a[i][i];
  return b;
}

TEST(GaussianProcess, EqualsATwinByEliminationForRandomObservations) {
  Stream stream(1, Purpose::test);
  for (int repetition = 0; repetition < 50; ++repetition) {
    const std::size_t dimensions = 1 + stream.below(6), count = 1 + stream.below(15);
    const auto random_point = [&] {
      Point point(dimensions);
      for (double& value : point) value = stream.uniform();
      return point;
    };
    GaussianProcess process(dimensions, 0.4, 0.01);
    std::vector<Point> points;
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(random_point());
      values.push_back(stream.normal());
      process.observe(points.back(), values.back());
    }
    std::vector<std::vector<double>> covariance(count, std::vector<double>(count));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        covariance[i][j] = matern(points[i], points[j], 0.4) + (i == j ? 0.01 : 0.0);
    for (int i = 0; i < 10; ++i) {
      const Point at = random_point();
      std::vector<double> k(count);
      for (std::size_t j = 0; j < count; ++j) k[j] = matern(points[j], at, 0.4);
      const auto weights = solve(covariance, values), reduced = solve(covariance, k);
      double mean = 0.0, variance = 1.0;
      for (std::size_t j = 0; j < count; ++j) mean += k[j] * weights[j], variance -= k[j] * reduced[j];
      EXPECT_NEAR(process.predict(at).mean, mean, 1e-9);
      EXPECT_NEAR(process.predict(at).variance, variance, 1e-9);
    }
  }
}

TEST(GaussianProcess, PredictsWhatScikitLearnPredicts) {
  const auto oracles =
      nlohmann::json::parse(std::ifstream(AMBLE_SOURCE_DIR "/tests/adaptation/oracles.json"));
  ASSERT_EQ(oracles.at("sets").size(), 24u);
  for (const auto& set : oracles.at("sets")) {
    const auto points = set.at("points").get<std::vector<Point>>(),
               queries = set.at("queries").get<std::vector<Point>>();
    GaussianProcess process(points[0].size(), set.at("length_scale"), set.at("noise_variance"));
    for (std::size_t i = 0; i < points.size(); ++i) process.observe(points[i], set.at("values").at(i));
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto predicted = process.predict(queries[i]);
      EXPECT_NEAR(predicted.mean, set.at("mean").at(i).get<double>(), 1e-9);
      EXPECT_NEAR(predicted.variance, set.at("variance").at(i).get<double>(), 1e-9);
    }
  }
}

TEST(GaussianProcess, IsSureWhereItObservedAndTakesTheSamePointTwice) {
  GaussianProcess process(1, 0.4, 1e-6);
  process.observe(Point{0.5}, 2.0);
  process.observe(Point{0.5}, 2.0);
  EXPECT_NEAR(process.predict(Point{0.5}).mean, 2.0, 1e-5);
  EXPECT_NEAR(process.predict(Point{0.5}).variance, 0.0, 1e-5);
  EXPECT_GE(process.predict(Point{0.5}).variance, 0.0);
  EXPECT_NEAR(process.predict(Point{500.0}).variance, 1.0, 1e-12);
}

}  // namespace
}  // namespace amble::adaptation
