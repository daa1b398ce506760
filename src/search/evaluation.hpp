#pragma once

#include <span>

namespace amble::search {

/// The result of evaluating one candidate: the objective over all of its episodes (trials under different
/// scenarios), and the behaviour of the first.
struct Evaluation {
  double objective = 0.0;            ///< finite, ≥ 0; higher is better
  std::span<const float> behaviour;  ///< same length for all; empty if the search needs none
};

}  // namespace amble::search
