#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// Measures gaits: footfalls, strides, phases, classification, speed, energy (docs/GAIT.md).
///
///   meter.hpp           frame by frame → Report: start here
///   recorded_gait.hpp   the same for a recording file
///   report.hpp          all measurements of a trial; report_text.hpp: as JSON, as a table, as a few lines
///   gait.hpp            names of gaits and the classification of footfall phases
///   settings.hpp        how footfalls are found
///   body.hpp            what is needed of a robot
/// and inside of Meter
///   contact_filter.hpp  debounces touch sensors
///   strides.hpp         touch-downs, strides and phases; circular.hpp: statistics of phases
///   windows.hpp         the parts of a trial, each with a classification
///   travel.hpp          distance, path, work of the motors
namespace amble::gait {

/// The order and timing of a quadruped's footfalls.
enum class Gait : std::uint8_t { walk_lateral, walk_diagonal, trot, pace, bound, pronk, gallop, irregular };
inline constexpr std::array<std::string_view, 8> gait_names{
    "walk lateral", "walk diagonal", "trot", "pace", "bound", "pronk", "gallop", "irregular"};

/// Why a gait is classified as irregular.
enum class Irregular : std::uint8_t {
  no,             ///< it is regular
  few_strides,    ///< a foot made fewer than min_strides strides (perhaps it never lands or never lifts)
  uneven_counts,  ///< the feet do not land equally often
  spread_phases,  ///< the phases of the footfalls vary too much
  mixed_pairs,    ///< one pair of feet alternates and the other does not
};
inline constexpr std::array<std::string_view, 5> irregular_names{"", "few strides", "uneven counts",
                                                                 "spread phases", "mixed pairs"};

/// When one foot lands, after another, as a share of the other's stride.
struct PairPhase {
  double phase = 0.0;      ///< circular mean, [0, 1)
  double resultant = 0.0;  ///< length of the mean vector: 1 if all phases are equal, 0 if they are uniform
  std::int64_t count = 0;  ///< of touch-downs
};

/// The input of classify().
struct QuadrupedPhases {
  PairPhase hind;        ///< right hind foot after left hind foot
  PairPhase fore;        ///< right fore foot after left fore foot
  PairPhase left;        ///< left fore foot after left hind foot
  PairPhase right;       ///< right fore foot after right hind foot
  double lateral = 0.0;  ///< circular mean of `left` and `right` together: Hildebrand's lateral phase D
  std::array<std::int64_t, 4> strides{};  ///< of the four feet, in any order
};

struct Classification {
  Gait gait = Gait::irregular;
  Irregular reason = Irregular::few_strides;

  friend bool operator==(const Classification&, const Classification&) = default;
};

// Thresholds of classify(), in strides.
inline constexpr std::int64_t min_strides = 4;
inline constexpr double min_resultant = 0.7;
inline constexpr double pair_tolerance = 0.1;  ///< of a pair of feet about 0 (together) or ½ (alternating)
inline constexpr double lateral_tolerance = 0.0625;  ///< of D about pace and trot

/// The classification of docs/GAIT.md, after Hildebrand (Science 150:701–708, 1965; Bioscience 39:766–775,
/// 1989). Boundary values belong to the narrower class.
Classification classify(const QuadrupedPhases& phases);

}  // namespace amble::gait
