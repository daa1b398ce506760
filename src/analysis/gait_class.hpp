#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace amble::analysis {

/// The order and timing of a quadruped's footfalls (docs/GAIT.md).
enum class Gait : std::uint8_t { walk_lateral, walk_diagonal, trot, pace, bound, pronk, gallop, irregular };
inline constexpr std::array<std::string_view, 8> gait_names{
    "walk lateral", "walk diagonal", "trot", "pace", "bound", "pronk", "gallop", "irregular"};

/// Why a gait is called irregular.
enum class Irregular : std::uint8_t {
  no,             ///< it is not
  few_strides,    ///< a foot made fewer than min_strides strides (it may never land, or never lift)
  uneven_counts,  ///< the feet do not land equally often
  spread_phases,  ///< the footfalls do not keep their order in time
  mixed_pairs,    ///< one pair of feet alternates and the other does not
};
inline constexpr std::array<std::string_view, 5> irregular_names{"", "few strides", "uneven counts",
                                                                 "spread phases", "mixed pairs"};

/// When one foot lands, after another, as a share of the other's stride.
struct PairPhase {
  double phase = 0.0;      ///< circular mean, [0, 1)
  double resultant = 0.0;  ///< 1: always the same; 0: all round the circle
  std::int64_t count = 0;  ///< of touch-downs behind it
};

/// What the rule looks at.
struct QuadrupedPhases {
  PairPhase hind;        ///< right hind foot after left hind foot
  PairPhase fore;        ///< right fore foot after left fore foot
  PairPhase left;        ///< left fore foot after left hind foot
  PairPhase right;       ///< right fore foot after right hind foot
  double lateral = 0.0;  ///< circular mean of `left` and `right` together: Hildebrand's lateral phase D
  std::array<std::int64_t, 4> strides{};  ///< of the four feet, in any order
};

struct Verdict {
  Gait gait = Gait::irregular;
  Irregular reason = Irregular::few_strides;

  friend bool operator==(const Verdict&, const Verdict&) = default;
};

// The numbers of the rule, in strides.
inline constexpr std::int64_t min_strides = 4;
inline constexpr double min_resultant = 0.7;
inline constexpr double pair_tolerance = 0.1;        ///< of a pair of feet about together or alternating
inline constexpr double lateral_tolerance = 0.0625;  ///< of D about pace and trot

/// The rule of docs/GAIT.md, after Hildebrand (Science 150:701–708, 1965; Bioscience 39:766–775, 1989). All
/// borders belong to the narrower class.
Verdict classify(const QuadrupedPhases& phases);

}  // namespace amble::analysis
