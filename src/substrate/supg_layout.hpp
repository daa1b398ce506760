#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "amble/cppn/network.hpp"
#include "amble/io/settings.hpp"

namespace amble::substrate {

/// Which of the CPPN's first two inputs, x or y, tells the legs apart; the other tells the joint types apart.
enum class LegAxis { x, y };
inline constexpr std::array<std::string_view, 2> leg_axis_names{"x", "y"};

/// Where the SUPGs stand in the substrate (Morse et al. 2013, figure 4). Coordinates have no unit.
struct SupgLayoutSettings {
  /// The paper's text spreads the types along x; the authors' code gives legs to the first input. The same
  /// but for names.
  LegAxis leg_axis = LegAxis::x;
  std::vector<double> leg_coordinates{-1.0, -0.33, 0.33, 1.0};  ///< one per leg, in the robot's order of legs
  /// Leg coordinates are divided by this, so that the SUPGs of one joint type stand close together.
  double leg_divisor = 50.0;
  std::vector<double> type_coordinates{-1.0, 0.0,
                                       1.0};  ///< one per joint type, in the robot's order of types

  void describe(io::SettingsVisitor& visitor);
};

/// All questions that a SUPG controller has for its CPPN, laid down once and shared by every genome: the
/// value of each SUPG at each tick of its timer, and the offset of each leg. As for every node property, a
/// coordinate that a property does not depend on is 0: an offset is asked for with type 0 and time 0, so that
/// the SUPGs of a leg share it (Morse et al. 2013, sec. 3).
class SupgLayout {
 public:
  /// CPPN inputs: x, y, time (in periods).
  static constexpr int inputs = 3;

  /// Throws UserError unless there is one coordinate per leg and per type.
  SupgLayout(const SupgLayoutSettings& settings, int legs, int types, int period_ticks);

  const cppn::Points& points() const { return points_; }
  /// The query of SUPG (leg, type) at time tick / period_ticks, tick in 0 … period_ticks.
  int pattern_point(int leg, int type, int tick) const {
    return (leg * types_ + type) * (period_ticks_ + 1) + tick;
  }
  int offset_point(int leg) const { return pattern_point(legs_, 0, 0) + leg; }

 private:
  int legs_, types_, period_ticks_;
  cppn::Points points_;
};

}  // namespace amble::substrate
