#include "amble/adaptation/trial_and_error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"

namespace amble::adaptation {

TrialAndError::TrialAndError(std::vector<Candidate> candidates, const TrialAndErrorSettings& settings)
    : candidates_(std::move(candidates)),
      settings_(settings),
      unit_(candidates_.empty() ? 0.0 : std::ranges::max(candidates_, {}, &Candidate::expected).expected),
      process_(candidates_.empty() ? 1 : candidates_.front().descriptor.size(), settings.length_scale,
               settings.noise_variance, settings.turns),
      deviation_(candidates_.size(), 1.0) {
  AMBLE_CHECK(unit_ > 0.0, "a candidate of which something is expected");
  mean_.reserve(candidates_.size());
  for (const Candidate& candidate : candidates_) mean_.push_back(candidate.expected / unit_);
}

std::size_t TrialAndError::next() const {
  std::size_t best = 0;
  const auto bound = [this](std::size_t i) { return mean_[i] + settings_.exploration * deviation_[i]; };
  for (std::size_t i = 1; i < candidates_.size(); ++i)
    if (bound(i) > bound(best)) best = i;
  return best;
}

void TrialAndError::tell(std::size_t candidate, double measured) {
  const double share = measured / unit_;
  tried_.push_back(candidate);
  // The process models how the robot differs from the map.
  process_.observe(candidates_[candidate].descriptor, share - candidates_[candidate].expected / unit_);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Prediction difference = process_.predict(candidates_[i].descriptor);
    mean_[i] = candidates_[i].expected / unit_ + difference.mean;
    deviation_[i] = std::sqrt(difference.variance);
  }
}

bool TrialAndError::done() const {
  return !tried_.empty() && mean_[best()] >= settings_.stop_share * std::ranges::max(mean_);
}

std::size_t TrialAndError::best() const {
  AMBLE_CHECK(!tried_.empty(), "a trial");
  return *std::ranges::max_element(tried_, {}, [this](std::size_t candidate) { return mean_[candidate]; });
}

double TrialAndError::mean(std::size_t candidate) const {
  return mean_[candidate] * unit_;
}

double TrialAndError::deviation(std::size_t candidate) const {
  return deviation_[candidate] * unit_;
}

}  // namespace amble::adaptation
