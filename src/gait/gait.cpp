#include "amble/gait/gait.hpp"

#include <algorithm>
#include <span>

#include "amble/gait/circular.hpp"

namespace amble::gait {
namespace {

bool about(double phase, double centre, double tolerance) {
  return phase_distance(phase, centre) <= tolerance;
}

/// They differ by more than a quarter, not counting the one stride by which the limits of a window can change
/// a count.
bool uneven(std::span<const std::int64_t> strides) {
  const auto [fewest, most] = std::ranges::minmax(strides);
  return 4 * (most - 1) > 5 * fewest;
}

Gait symmetrical(double lateral) {
  if (about(lateral, 0.0, lateral_tolerance)) return Gait::pace;
  if (about(lateral, 0.5, lateral_tolerance)) return Gait::trot;
  return lateral < 0.5 ? Gait::walk_lateral : Gait::walk_diagonal;
}

/// What all gaits need, however many legs.
Irregular steadiness(std::span<const std::int64_t> strides, std::span<const PairPhase> phases) {
  if (std::ranges::min(strides) < min_strides) return Irregular::few_strides;
  if (uneven(strides)) return Irregular::uneven_counts;
  for (const PairPhase& pair : phases)
    if (pair.resultant < min_resultant) return Irregular::spread_phases;
  return Irregular::no;
}

bool all_about(std::span<const PairPhase> pairs, double centre) {
  return std::ranges::all_of(
      pairs, [&](const PairPhase& pair) { return about(pair.phase, centre, pair_tolerance); });
}

}  // namespace

Classification classify(const QuadrupedPhases& phases) {
  const std::array steady{phases.hind, phases.fore, phases.left, phases.right};
  if (const auto reason = steadiness(phases.strides, steady); reason != Irregular::no)
    return {Gait::irregular, reason};

  const bool hind_alternates = about(phases.hind.phase, 0.5, pair_tolerance),
             fore_alternates = about(phases.fore.phase, 0.5, pair_tolerance);
  if (hind_alternates && fore_alternates) return {symmetrical(phases.lateral), Irregular::no};
  if (hind_alternates || fore_alternates) return {Gait::irregular, Irregular::mixed_pairs};
  const bool together =
      about(phases.hind.phase, 0.0, pair_tolerance) && about(phases.fore.phase, 0.0, pair_tolerance);
  if (!together) return {Gait::gallop, Irregular::no};
  return {about(phases.lateral, 0.0, pair_tolerance) ? Gait::pronk : Gait::bound, Irregular::no};
}

Classification classify(const HexapodPhases& phases) {
  for (const std::span<const PairPhase> some :
       {std::span<const PairPhase>(phases.pairs), std::span<const PairPhase>(phases.lags)})
    if (const auto reason = steadiness(phases.strides, some); reason != Irregular::no)
      return {Gait::irregular, reason};
  for (const PairPhase& lag : phases.lags)
    if (!about(lag.phase, phases.lag, pair_tolerance)) return {Gait::irregular, Irregular::uneven_lags};

  const bool third = about(phases.lag, 1.0 / 3.0, lag_tolerance);
  if (!all_about(phases.pairs, 0.5)) {
    // With lags of a third, legs of both sides may swing two by two.
    const bool by_thirds = all_about(phases.pairs, 1.0 / 3.0) || all_about(phases.pairs, 2.0 / 3.0);
    if (third && by_thirds) return {Gait::tetrapod, Irregular::no};
    return {Gait::irregular, Irregular::no_alternation};
  }
  if (about(phases.lag, 0.5, lag_tolerance)) return {Gait::tripod, Irregular::no};
  if (about(phases.lag, 1.0 / 6.0, lag_tolerance)) return {Gait::wave, Irregular::no};
  if (third) return {Gait::tetrapod, Irregular::no};
  return {Gait::irregular, Irregular::no_wave};
}

Classification classify(const BipedPhases& phases) {
  const std::array steady{phases.pair};
  if (const auto reason = steadiness(phases.strides, steady); reason != Irregular::no)
    return {Gait::irregular, reason};
  if (about(phases.pair.phase, 0.0, pair_tolerance)) return {Gait::hop, Irregular::no};
  if (!about(phases.pair.phase, 0.5, pair_tolerance)) return {Gait::irregular, Irregular::no_alternation};
  return {phases.duty_factor >= 0.5 ? Gait::walk : Gait::run, Irregular::no};
}

}  // namespace amble::gait
