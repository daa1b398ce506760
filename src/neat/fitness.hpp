#pragma once

namespace amble::neat {

/// What a search makes of one genome's evaluation.
struct Fitness {
  /// Finite, ≥ 0: decides offspring counts and the roulette (novelty, or the objective itself).
  double selection = 0.0;
  /// Finite: ranks the members of a species, for elites and survival (Morse et al. 2013, sec. 4).
  double objective = 0.0;
};

}  // namespace amble::neat
