#pragma once

#include <vector>

#include "amble/statistics/survival.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics::tests {

/// From [[[time, ended], …], …], one list per group.
inline std::vector<std::vector<Lifetime>> lifetimes_of(const Json& groups) {
  std::vector<std::vector<Lifetime>> all;
  for (const auto& group : groups) {
    auto& lifetimes = all.emplace_back();
    for (const auto& pair : group) lifetimes.push_back({pair[0].get<double>(), pair[1].get<bool>()});
  }
  return all;
}

}  // namespace amble::statistics::tests
