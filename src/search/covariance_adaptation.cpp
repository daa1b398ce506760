#include "amble/search/covariance_adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/elementary.hpp"
#include "amble/core/index.hpp"

namespace amble::search {
namespace {

double norm(std::span<const double> vector) {
  double sum = 0.0;
  for (const double value : vector) sum += value * value;
  return std::sqrt(sum);
}

/// Weights of the better half, falling with the logarithm of the rank; they add up to 1.
std::vector<double> recombination_weights(int candidates) {
  std::vector<double> weights;
  double sum = 0.0;
  for (int rank = 1; rank <= candidates / 2; ++rank) {
    weights.push_back(portable::log((candidates + 1) / 2.0) - portable::log(rank));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

CovarianceAdaptation::CovarianceAdaptation(std::vector<double> mean, double step, int candidates)
    : weights_(recombination_weights(candidates)), mean_(std::move(mean)), step_(step) {
  AMBLE_CHECK(candidates >= 4 && step > 0.0 && !mean_.empty(), "a distribution that can be sampled");
  const auto n = static_cast<double>(mean_.size());
  double squares = 0.0;
  for (const double weight : weights_) squares += weight * weight;
  mu_eff_ = 1.0 / squares;
  c_sigma_ = (mu_eff_ + 2.0) / (n + mu_eff_ + 5.0);
  d_sigma_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff_ - 1.0) / (n + 1.0)) - 1.0) + c_sigma_;
  c_c_ = (4.0 + mu_eff_ / n) / (n + 4.0 + 2.0 * mu_eff_ / n);
  c_1_ = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff_);
  c_mu_ = std::min(1.0 - c_1_, 2.0 * (mu_eff_ - 2.0 + 1.0 / mu_eff_) / ((n + 2.0) * (n + 2.0) + mu_eff_));
  expected_norm_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));

  path_sigma_.assign(mean_.size(), 0.0);
  path_c_.assign(mean_.size(), 0.0);
  covariance_.assign(mean_.size() * mean_.size(), 0.0);
  for (int i = 0; i < dimensions(); ++i) covariance(i, i) = 1.0;
  factor_ = covariance_;
}

std::size_t CovarianceAdaptation::index(int row, int column) const {
  return to_index(row) * mean_.size() + to_index(column);
}

std::vector<double> CovarianceAdaptation::sample(std::span<const double> normal) const {
  std::vector<double> point = mean_;
  for (int row = 0; row < dimensions(); ++row) {
    double sum = 0.0;
    for (int column = 0; column <= row; ++column) sum += factor(row, column) * normal[to_index(column)];
    point[to_index(row)] += step_ * sum;
  }
  return point;
}

/// The factor's inverse times the vector, by forward substitution.
std::vector<double> CovarianceAdaptation::whitened(std::vector<double> difference) const {
  for (int row = 0; row < dimensions(); ++row) {
    double rest = difference[to_index(row)];
    for (int column = 0; column < row; ++column) rest -= factor(row, column) * difference[to_index(column)];
    difference[to_index(row)] = rest / factor(row, row);
  }
  return difference;
}

void CovarianceAdaptation::update(std::span<const std::vector<double>> best_first) {
  AMBLE_CHECK(best_first.size() >= weights_.size(), "as many points as there are parents");
  AMBLE_CHECK(sound_, "a distribution that can be sampled");
  const std::size_t n = mean_.size();
  std::vector<std::vector<double>> differences(weights_.size(), std::vector<double>(n));
  std::vector<double> moved(n, 0.0);
  for (std::size_t i = 0; i < weights_.size(); ++i)
    for (std::size_t d = 0; d < n; ++d) {
      differences[i][d] = (best_first[i][d] - mean_[d]) / step_;
      moved[d] += weights_[i] * differences[i][d];
    }
  for (std::size_t d = 0; d < n; ++d) mean_[d] += step_ * moved[d];

  // The two paths: where the mean went over the last rounds, in units of the distribution and of the step.
  const std::vector<double> white = whitened(moved);
  const double keep = 1.0 - c_sigma_, take = std::sqrt(c_sigma_ * (2.0 - c_sigma_) * mu_eff_);
  for (std::size_t d = 0; d < n; ++d) path_sigma_[d] = keep * path_sigma_[d] + take * white[d];
  ++rounds_;
  const double length = norm(path_sigma_) / std::sqrt(1.0 - portable::power(keep * keep, rounds_));
  const bool settled = length < (1.4 + 2.0 / (static_cast<double>(n) + 1.0)) * expected_norm_;
  const double take_c = settled ? std::sqrt(c_c_ * (2.0 - c_c_) * mu_eff_) : 0.0;
  for (std::size_t d = 0; d < n; ++d) path_c_[d] = (1.0 - c_c_) * path_c_[d] + take_c * moved[d];

  adapt_covariance(differences, settled);
  step_ *= portable::exp(c_sigma_ / d_sigma_ * (norm(path_sigma_) / expected_norm_ - 1.0));
  factorise();
}

void CovarianceAdaptation::adapt_covariance(std::span<const std::vector<double>> differences, bool settled) {
  const double keep = 1.0 - c_1_ - c_mu_ + (settled ? 0.0 : c_1_ * c_c_ * (2.0 - c_c_));
  for (int row = 0; row < dimensions(); ++row)
    for (int column = 0; column <= row; ++column) {
      const std::size_t r = to_index(row), c = to_index(column);
      double spread = 0.0;
      for (std::size_t i = 0; i < weights_.size(); ++i)
        spread += weights_[i] * differences[i][r] * differences[i][c];
      covariance(row, column) =
          keep * covariance(row, column) + c_1_ * path_c_[r] * path_c_[c] + c_mu_ * spread;
    }
}

/// The lower half of the covariance is what counts.
void CovarianceAdaptation::factorise() {
  for (int row = 0; row < dimensions(); ++row)
    for (int column = 0; column <= row; ++column) {
      double rest = covariance(row, column);
      for (int k = 0; k < column; ++k) rest -= factor(row, k) * factor(column, k);
      if (row == column && !(rest > 0.0)) {
        sound_ = false;
        return;
      }
      factor_[index(row, column)] = row == column ? std::sqrt(rest) : rest / factor(column, column);
    }
  sound_ = std::isfinite(step_) && step_ > 0.0;
}

double CovarianceAdaptation::widest() const {
  double most = 0.0;
  for (int row = 0; row < dimensions(); ++row) most = std::max(most, covariance_[index(row, row)]);
  return step_ * std::sqrt(most);
}

double CovarianceAdaptation::narrowest() const {
  double least = factor(0, 0);
  for (int row = 1; row < dimensions(); ++row) least = std::min(least, factor(row, row));
  return step_ * least;
}

void CovarianceAdaptation::save(io::BinaryWriter& writer) const {
  writer.put(rounds_);
  writer.put(step_);
  writer.put(sound_);
  for (const auto* values : {&mean_, &path_sigma_, &path_c_, &covariance_, &factor_})
    writer.put_span(std::span<const double>(*values));
}

void CovarianceAdaptation::load(io::BinaryReader& reader) {
  rounds_ = reader.get<int>();
  step_ = reader.get<double>();
  sound_ = reader.get<bool>();
  for (auto* values : {&mean_, &path_sigma_, &path_c_, &covariance_, &factor_}) {
    std::vector<double> read = reader.get_vector<double>();
    if (read.size() != values->size()) reader.bad("a distribution of other dimensions");
    *values = std::move(read);
  }
  const auto finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  };
  if (rounds_ < 0 || !sound_ || !std::isfinite(step_) || !(step_ > 0.0) || !finite(mean_) || !finite(factor_))
    reader.bad("a distribution that cannot be");
}

}  // namespace amble::search
