#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// Measures gaits: footfalls, strides, phases, classification, speed, energy (docs/GAIT.md).
///
///   meter.hpp           frame by frame → Report: start here
///   recorded_gait.hpp   the same for a recording file
///   report.hpp          how footfalls are found, and all measurements of a trial
///   report_text.hpp     these as JSON, as a table, as a few lines
///   gait.hpp            names of gaits and the classification of footfall phases
///   body.hpp            what is needed of a robot
/// and inside of Meter, which debounces touch sensors
///   strides.hpp         touch-downs, strides and phases; circular.hpp: statistics of phases
///   windows.hpp         the parts of a trial, each with a classification
///   travel.hpp          distance, path, work of the motors
namespace amble::gait {

/// The order and timing of footfalls, with names for four, six and two legs.
enum class Gait : std::uint8_t {
  walk_lateral,
  walk_diagonal,
  trot,
  pace,
  bound,
  pronk,
  gallop,
  tripod,
  tetrapod,
  wave,
  walk,
  run,
  hop,
  irregular,
};
inline constexpr std::array<std::string_view, 14> gait_names{
    "walk lateral", "walk diagonal", "trot", "pace", "bound", "pronk", "gallop",
    "tripod",       "tetrapod",      "wave", "walk", "run",   "hop",   "irregular"};
/// How many legs the robots have of which it is a gait; 0: four, six or two.
inline constexpr std::array<std::size_t, gait_names.size()> gait_legs{4, 4, 4, 4, 4, 4, 4,
                                                                      6, 6, 6, 2, 2, 2, 0};

/// Why a gait is classified as irregular.
enum class Irregular : std::uint8_t {
  no,              ///< it is regular
  few_strides,     ///< a foot made fewer than min_strides strides (perhaps it never lands or never lifts)
  uneven_counts,   ///< the feet do not land equally often
  spread_phases,   ///< the phases of the footfalls vary too much
  mixed_pairs,     ///< one pair of feet alternates and the other does not
  no_alternation,  ///< of two or six legs, a left and a right foot do not alternate (nor land together, of
                   ///< two)
  uneven_lags,     ///< of six legs, not all land equally long after the one behind them
  no_wave,         ///< of six legs, those of a side land together, or from front to back
};
inline constexpr std::array<std::string_view, 8> irregular_names{
    "",       "few strides", "uneven counts", "spread phases", "mixed pairs", "no alternation", "uneven lags",
    "no wave"};

/// When one foot lands, after another, as a share of the other's stride.
struct PairPhase {
  double phase = 0.0;      ///< circular mean, [0, 1)
  double resultant = 0.0;  ///< length of the mean vector: 1 if all phases are equal, 0 if they are uniform
  std::int64_t count = 0;  ///< of touch-downs
};

/// The input of classify() for four legs, two behind two.
struct QuadrupedPhases {
  PairPhase hind;        ///< right hind foot after left hind foot
  PairPhase fore;        ///< right fore foot after left fore foot
  PairPhase left;        ///< left fore foot after left hind foot
  PairPhase right;       ///< right fore foot after right hind foot
  double lateral = 0.0;  ///< circular mean of `left` and `right` together: Hildebrand's lateral phase D
  std::array<std::int64_t, 4> strides{};  ///< of the four feet, in any order
};

/// For six legs in three pairs.
struct HexapodPhases {
  std::array<PairPhase, 3> pairs;  ///< right foot after left foot: fore, middle, hind
  /// When a foot lands after the one behind it: left middle, left fore, right middle, right fore.
  std::array<PairPhase, 4> lags;
  double lag = 0.0;  ///< circular mean of all of `lags`
  std::array<std::int64_t, 6> strides{};
};

/// For two legs, a left and a right one.
struct BipedPhases {
  PairPhase pair;            ///< right foot after left foot
  double duty_factor = 0.0;  ///< mean of both; of meaning once both have made a stride
  std::array<std::int64_t, 2> strides{};
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
inline constexpr double lag_tolerance = 1.0 / 12.0;  ///< of a hexapod's lag about 1/2, 1/3 and 1/6

/// The classification of docs/GAIT.md, after Hildebrand (Science 150:701–708, 1965; Bioscience 39:766–775,
/// 1989). Boundary values belong to the narrower class.
Classification classify(const QuadrupedPhases& phases);
/// After Wilson (Annual Review of Entomology 11:103–122, 1966).
Classification classify(const HexapodPhases& phases);
/// After Alexander (Int. J. Robotics Research 3(2):49–59, 1984).
Classification classify(const BipedPhases& phases);

}  // namespace amble::gait
