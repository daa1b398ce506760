#pragma once

#include <span>

namespace amble::search {

/// The result of evaluating one candidate: the objective and the behaviour over all of its episodes
/// (trials under different scenarios).
struct Evaluation {
  double objective = 0.0;            ///< finite, ≥ 0; higher is better
  std::span<const float> behaviour;  ///< same length for all; empty if the search needs none
  bool viable = true;                ///< false: a simulation diverged, so that its behaviour means nothing
};

}  // namespace amble::search
