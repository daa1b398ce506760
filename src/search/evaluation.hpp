#pragma once

#include <span>

namespace amble::search {

/// What became of one candidate: how good it was, and what it did.
struct Evaluation {
  double objective = 0.0;            ///< ≥ 0, finite; more is better
  std::span<const float> behaviour;  ///< same length for all; empty where the search compares none
};

}  // namespace amble::search
