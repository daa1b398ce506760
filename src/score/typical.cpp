#include "amble/score/typical.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::score {

Typical typical(std::span<const double> values, std::span<const record::Outcome> outcomes) {
  AMBLE_CHECK(!values.empty() && values.size() == outcomes.size(), "each trial has a value and an outcome");
  const auto ended_early = std::ranges::count_if(
      outcomes, [](record::Outcome outcome) { return outcome != record::Outcome::completed; });
  return {.trials = values.size(),
          .median = statistics::median(values),
          .lower_quartile = statistics::quantile(values, 0.25),
          .upper_quartile = statistics::quantile(values, 0.75),
          .best = std::ranges::max(values),
          .fell_share = static_cast<double>(ended_early) / static_cast<double>(values.size())};
}

}  // namespace amble::score
