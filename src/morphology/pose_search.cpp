#include "amble/morphology/pose_search.hpp"

#include <algorithm>
#include <utility>

namespace amble::morphology {

std::vector<double> lower_cost(const std::function<double(const std::vector<double>&)>& cost,
                               std::vector<double> at, const std::vector<double>& lower,
                               const std::vector<double>& upper, double& best) {
  const auto clamped = [&](std::size_t i, double value) { return std::clamp(value, lower[i], upper[i]); };
  const auto explore = [&](std::vector<double> from, double& value, double step) {
    for (std::size_t i = 0; i < from.size(); ++i)
      for (const double by : {step, -step}) {
        std::vector<double> next = from;
        next[i] = clamped(i, from[i] + by);
        if (const double there = cost(next); there < value) {
          value = there;
          from = std::move(next);
          break;
        }
      }
    return from;
  };
  best = cost(at);
  constexpr double first_rad = 0.2, last_rad = 1e-5;
  for (double step = first_rad; step > last_rad;) {
    double value = best;
    std::vector<double> next = explore(at, value, step);
    if (value >= best) {
      step *= 0.5;
      continue;
    }
    // On in the same direction for as long as it pays.
    while (value < best) {
      std::vector<double> beyond = next;
      for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] = clamped(i, 2.0 * next[i] - at[i]);
      best = value;
      at = std::move(next);
      value = cost(beyond);
      next = explore(std::move(beyond), value, step);
    }
  }
  return at;
}

double evenly(int n, int base) {
  double value = 0.0, share = 1.0;
  for (; n > 0; n /= base) {
    share /= base;
    value += share * (n % base);
  }
  return value;
}

}  // namespace amble::morphology
