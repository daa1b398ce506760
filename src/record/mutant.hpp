#pragma once

namespace amble::record {

/// What one mutation makes of a genome: a mutant beside its parent, both in the same trials.
struct Mutant {
  double kept = 0.0;    ///< its score / the parent's, ≥ 0; 0 if the parent's is 0
  double change = 0.0;  ///< of the gait: mean over the legs of |duty factor − the parent's|, 0 … 1

  static constexpr double viable_from = 0.5;  ///< share of the parent's score
  bool viable() const { return kept >= viable_from; }

  friend bool operator==(const Mutant&, const Mutant&) = default;
};

}  // namespace amble::record
