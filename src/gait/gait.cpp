#include "amble/gait/gait.hpp"

#include <algorithm>

#include "amble/gait/circular.hpp"

namespace amble::gait {
namespace {

bool about(double phase, double centre, double tolerance) {
  return phase_distance(phase, centre) <= tolerance;
}

/// They differ by more than a quarter, not counting the one stride by which the limits of a window can change
/// a count.
bool uneven(const std::array<std::int64_t, 4>& strides) {
  const auto [fewest, most] = std::ranges::minmax(strides);
  return 4 * (most - 1) > 5 * fewest;
}

Gait symmetrical(double lateral) {
  if (about(lateral, 0.0, lateral_tolerance)) return Gait::pace;
  if (about(lateral, 0.5, lateral_tolerance)) return Gait::trot;
  return lateral < 0.5 ? Gait::walk_lateral : Gait::walk_diagonal;
}

}  // namespace

Classification classify(const QuadrupedPhases& phases) {
  if (std::ranges::min(phases.strides) < min_strides) return {Gait::irregular, Irregular::few_strides};
  if (uneven(phases.strides)) return {Gait::irregular, Irregular::uneven_counts};
  for (const PairPhase& pair : {phases.hind, phases.fore, phases.left, phases.right})
    if (pair.resultant < min_resultant) return {Gait::irregular, Irregular::spread_phases};

  const bool hind_alternates = about(phases.hind.phase, 0.5, pair_tolerance),
             fore_alternates = about(phases.fore.phase, 0.5, pair_tolerance);
  if (hind_alternates && fore_alternates) return {symmetrical(phases.lateral), Irregular::no};
  if (hind_alternates || fore_alternates) return {Gait::irregular, Irregular::mixed_pairs};
  const bool together =
      about(phases.hind.phase, 0.0, pair_tolerance) && about(phases.fore.phase, 0.0, pair_tolerance);
  if (!together) return {Gait::gallop, Irregular::no};
  return {about(phases.lateral, 0.0, pair_tolerance) ? Gait::pronk : Gait::bound, Irregular::no};
}

}  // namespace amble::gait
