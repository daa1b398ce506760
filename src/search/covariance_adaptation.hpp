#pragma once

#include <span>
#include <vector>

#include "amble/io/binary.hpp"

namespace amble::search {

/// The covariance matrix adaptation evolution strategy on numbers alone: (μ/μ_w, λ)-CMA-ES with positive
/// weights and the parameters of N. Hansen, "The CMA Evolution Strategy: A Tutorial" (arXiv 1604.00772; c_μ
/// as in pyribs, 2 (μ − 2 + 1/μ) / …, where pycma adds ¼ to the bracket), with the Cholesky factor of the
/// covariance in place of its square root (Krause, Arbonès & Igel, NIPS 2016). That needs + − × ÷ √ and what
/// core/elementary.hpp has, so that the same numbers come out on any computer.
///
/// A round: sample() as many points as there are candidates, rank them by any means, update().
class CovarianceAdaptation {
 public:
  /// Starts around `mean` with standard deviation `step` > 0 in each dimension; `candidates` ≥ 4 a round.
  CovarianceAdaptation(std::vector<double> mean, double step, int candidates);

  int dimensions() const { return static_cast<int>(mean_.size()); }
  const std::vector<double>& mean() const { return mean_; }
  double step() const { return step_; }
  /// How many of the best update() uses.
  int parents() const { return static_cast<int>(weights_.size()); }

  /// The point that belongs to independent standard normal numbers, one a dimension.
  std::vector<double> sample(std::span<const double> normal) const;
  /// Moves the distribution towards the parents() best points of this round, the best first.
  void update(std::span<const std::vector<double>> best_first);

  /// Standard deviation along the widest and along the narrowest row of the factor: bounds of how far samples
  /// still differ.
  double widest() const;
  double narrowest() const;
  /// False if rounding has left the covariance without a factor: nothing more can be sampled.
  bool sound() const { return sound_; }

  void save(io::BinaryWriter& writer) const;
  /// Throws UserError(bad_file) if what was saved has other dimensions.
  void load(io::BinaryReader& reader);

 private:
  double& covariance(int row, int column) { return covariance_[index(row, column)]; }
  double factor(int row, int column) const { return factor_[index(row, column)]; }
  std::size_t index(int row, int column) const;
  std::vector<double> whitened(std::vector<double> difference) const;
  void adapt_covariance(std::span<const std::vector<double>> differences, bool step_is_settled);
  void factorise();

  // Constants, by the names of the tutorial.
  std::vector<double> weights_;
  double mu_eff_, c_sigma_, d_sigma_, c_c_, c_1_, c_mu_, expected_norm_;

  // State.
  int rounds_ = 0;
  std::vector<double> mean_;
  double step_;
  std::vector<double> path_sigma_, path_c_;
  std::vector<double> covariance_;  ///< dimensions × dimensions, row by row
  std::vector<double> factor_;      ///< its lower Cholesky factor
  bool sound_ = true;
};

}  // namespace amble::search
