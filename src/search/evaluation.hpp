#pragma once

#include <span>

namespace amble::search {

/// The result of evaluating one candidate.
struct Evaluation {
  double objective = 0.0;            ///< finite, ≥ 0; higher is better
  std::span<const float> behaviour;  ///< same length for all; empty if the search needs none
};

}  // namespace amble::search
