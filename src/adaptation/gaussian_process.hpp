#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace amble::adaptation {

/// What a Gaussian process says of a point: a normal distribution.
struct Prediction {
  double mean = 0.0;
  double variance = 1.0;  ///< ≥ 0
};

/// Regression by a Gaussian process of mean 0 and variance 1 (Rasmussen & Williams 2006, algorithm 2.1), with
/// the Matérn kernel of ν = 5/2: k(d) = (1 + √5 d/ρ + 5 d²/(3 ρ²)) exp(−√5 d/ρ), d the Euclidean distance,
/// along the chord in dimensions that are circles: of the way round the kernel is not positive definite.
/// Cost of observe(): O(n³) for n observations, of predict(): O(n²). Its last bits depend on the library's
/// exp().
class GaussianProcess {
 public:
  /// `length_scale` ρ > 0; `noise_variance` > 0 of each observation; `turns`: of each dimension a full turn,
  /// 0 of a line; empty: all are lines.
  GaussianProcess(std::size_t dimensions, double length_scale, double noise_variance,
                  std::vector<double> turns = {});

  void observe(std::span<const double> point, double value);
  Prediction predict(std::span<const double> point) const;
  std::size_t observations() const { return values_.size(); }

 private:
  double kernel(std::span<const double> a, std::span<const double> b) const;
  std::span<const double> point(std::size_t i) const {
    return std::span(points_).subspan(i * dimensions_, dimensions_);
  }

  std::size_t dimensions_;
  double length_scale_, noise_variance_;
  std::vector<double> turns_;
  std::vector<double> points_;  ///< one after the other
  std::vector<double> values_;
  std::vector<double> factor_;   ///< lower triangle L of K + σ² I = L Lᵀ, by columns
  std::vector<double> weights_;  ///< (K + σ² I)⁻¹ values
};

}  // namespace amble::adaptation
