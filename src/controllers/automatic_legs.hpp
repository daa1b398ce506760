#pragma once

#include <string>
#include <vector>

#include "amble/robot/legs.hpp"
#include "amble/robot/spec.hpp"

namespace amble::controllers {

/// Evenly spread over −1 … 1, to four decimals; 0 for one alone.
double evenly_spread(int index, int count);

/// A driven joint of a leg.
struct LegMotor {
  int type = 0;  ///< index into AutomaticLegs::types()
  std::string node, joint;
};

/// What automatic substrates know of a robot (automatic.hpp).
class AutomaticLegs {
 public:
  explicit AutomaticLegs(const robot::RobotSpec& robot);

  int count() const { return static_cast<int>(robot_.legs.size()); }
  const std::string& name(int leg) const;
  /// Number of joint types that some leg drives.
  int types() const { return static_cast<int>(types_.size()); }
  /// The leg's motors, type by type.
  std::vector<LegMotor> motors(int leg) const;
  /// Place of a type across a left or a right leg: 0 … types() − 1 from left to right.
  int place_across(int type, bool right) const;
  /// The leg's motors from left to right across it.
  std::vector<LegMotor> motors_across(int leg) const;

  /// From front to back; empty where left and right cannot be told.
  const std::vector<robot::LegPair>& pairs() const { return pairs_; }
  /// Whether it is the right leg of a pair.
  bool is_right(int leg) const;
  /// Where a pair's hips are along the robot, between hindmost (−1) and foremost (1); 0 for a single pair.
  double pair_y(std::size_t pair) const { return pair_y_[pair]; }

 private:
  void place_pairs(const std::vector<Vec3>& hips_m);

  const robot::RobotSpec& robot_;
  std::vector<int> types_;  ///< indices into RobotSpec::joint_types
  std::vector<robot::LegPair> pairs_;
  std::vector<double> pair_y_;
};

}  // namespace amble::controllers
