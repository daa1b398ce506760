#include <gtest/gtest.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/physics/damaged_engine.hpp"
#include "amble/robot/pose.hpp"
#include "tests/damage/scene.hpp"
#include "tests/physics/scene.hpp"

// Where damaged robots start.
namespace amble::physics {
namespace {

class DamagedStart : public OnEachEngine {};
ON_EACH_ENGINE(DamagedStart);

/// All joints of one type at the same share of their range, the others at 0.
std::vector<double> crouch_rad(const robot::RobotSpec& robot, std::size_t type, double share) {
  std::vector<double> angles_rad(robot.joints.size(), 0.0);
  for (const robot::Leg& leg : robot.legs) {
    const robot::Joint& joint = robot.joints[to_index(leg.joints[type])];
    angles_rad[to_index(leg.joints[type])] = share * (share < 0.0 ? -joint.lower_rad : joint.upper_rad);
  }
  return angles_rad;
}

TEST_P(DamagedStart, IsLiftedByLockedJointsThatReachLowerAndLoweredByNone) {
  const auto robot = quadruped();
  const robot::Pose root = robot::start_poses(robot)[0];
  int lifted = 0, higher = 0;
  for (const std::size_t type : {0u, 1u})
    for (const double before : {-0.4, 0.0, 0.4})
      for (const double share : {-0.8, -0.2, 0.2, 0.8}) {
        const auto start_rad = crouch_rad(robot, type, before), locked_rad = crouch_rad(robot, type, share);
        damage::Settings damage;
        for (const robot::Leg& leg : robot.legs) {
          const auto j = to_index(leg.joints[type]);
          damage.parts.push_back(damage::locked(robot.joints[j].name, locked_rad[j]));
        }
        const auto engine = make_damaged_engine(GetParam(), robot, damage, {.timestep_s = 0.01});
        engine->place_at(0, {{root.position_m, root.rotation}, start_rad});
        const double sunk_m = robot::clearance_m(robot, robot::poses_at(robot, root, start_rad)) -
                              robot::clearance_m(robot, robot::poses_at(robot, root, locked_rad));
        EXPECT_NEAR(engine->root_pose(0).position_m.z - root.position_m.z, std::max(0.0, sunk_m), 2e-6)
            << type << ": " << before << " to " << share;
        lifted += sunk_m > 1e-3;
        higher += sunk_m < -1e-3;
      }
  EXPECT_GT(lifted, 0);
  EXPECT_GT(higher, 0);
}

}  // namespace
}  // namespace amble::physics
