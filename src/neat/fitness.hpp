#pragma once

namespace amble::neat {

/// What a search says of one genome.
struct Fitness {
  double selection =
      0.0;  ///< finite, ≥ 0: decides offspring counts and the roulette (novelty, or the objective itself)
  double objective =
      0.0;  ///< finite; ranks the members of a species: elites and survival cut (Morse et al. 2013, sec. 4)
};

}  // namespace amble::neat
