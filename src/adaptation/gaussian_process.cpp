#include "amble/adaptation/gaussian_process.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/circle.hpp"

namespace amble::adaptation {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index size_of(const std::vector<double>& values) {
  return static_cast<Eigen::Index>(values.size());
}

}  // namespace

GaussianProcess::GaussianProcess(std::size_t dimensions, double length_scale, double noise_variance,
                                 std::vector<double> turns)
    : dimensions_(dimensions),
      length_scale_(length_scale),
      noise_variance_(noise_variance),
      turns_(std::move(turns)) {
  AMBLE_CHECK(dimensions > 0 && length_scale > 0.0 && noise_variance > 0.0, "a kernel that can be factored");
}

double GaussianProcess::kernel(std::span<const double> a, std::span<const double> b) const {
  const double scaled = std::sqrt(5.0 * squared_chord(a, b, turns_)) / length_scale_;
  return (1.0 + scaled + scaled * scaled / 3.0) * std::exp(-scaled);
}

void GaussianProcess::observe(std::span<const double> at, double value) {
  AMBLE_CHECK(at.size() == dimensions_, "a point of this space");
  points_.insert(points_.end(), at.begin(), at.end());
  values_.push_back(value);
  const Eigen::Index n = size_of(values_);
  Matrix covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) = kernel(point(static_cast<std::size_t>(i)), point(static_cast<std::size_t>(j))) +
                         (i == j ? noise_variance_ : 0.0);
  const Eigen::LLT<Matrix> cholesky(covariance);
  AMBLE_CHECK(cholesky.info() == Eigen::Success, "noise makes the covariance positive definite");
  const Matrix factor = cholesky.matrixL();
  factor_.assign(factor.data(), factor.data() + n * n);
  const Vector weights = cholesky.solve(Eigen::Map<const Vector>(values_.data(), n));
  weights_.assign(weights.data(), weights.data() + n);
}

Prediction GaussianProcess::predict(std::span<const double> at) const {
  AMBLE_CHECK(at.size() == dimensions_, "a point of this space");
  const Eigen::Index n = size_of(values_);
  if (n == 0) return {};
  Vector covariance(n);
  for (Eigen::Index i = 0; i < n; ++i) covariance(i) = kernel(at, point(static_cast<std::size_t>(i)));
  // Variance: k(x, x) − |L⁻¹ k|².
  const Eigen::Map<const Matrix> factor(factor_.data(), n, n);
  const Vector reduced = factor.triangularView<Eigen::Lower>().solve(covariance);
  return {.mean = covariance.dot(Eigen::Map<const Vector>(weights_.data(), n)),
          .variance = std::max(0.0, 1.0 - reduced.squaredNorm())};
}

}  // namespace amble::adaptation
