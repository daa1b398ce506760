#pragma once

#include <array>
#include <vector>

#include "amble/physics/batch/model.hpp"

namespace amble::physics::batch {

/// Robots that advance together, whatever the width of the machine's vectors.
constexpr int lanes = 16;

/// One quantity of all robots.
struct alignas(64) Row {
  std::array<float, lanes> lane{};
};

/// Where each quantity stands among the rows that outlive a step. Torso axes are those of the torso's frame;
/// positions in them count from the robot's centre of mass.
struct Rows {
  // State proper.
  static constexpr int com = 0;        ///< centre of mass, world, m: 3
  static constexpr int com_rest = 3;   ///< what com lost to rounding: 3
  static constexpr int rotation = 6;   ///< of the torso, quaternion w, x, y, z, torso axes → world: 4
  static constexpr int velocity = 10;  ///< of the centre of mass, world, m/s: 3
  static constexpr int spin = 13;      ///< angular momentum about the centre of mass, world, kg m²/s: 3
  // Flags, 0 or 1.
  static constexpr int active = 16;  ///< placed and not retired
  static constexpr int healthy = 17;
  // Follow from the state.
  static constexpr int axes = 18;      ///< the world's x, y, z axes in torso axes: 9
  static constexpr int origin = 27;    ///< of the torso's frame, torso axes, m: 3
  static constexpr int contacts = 30;  ///< points that touched at the beginning of the step before
  // Set from outside.
  static constexpr int push = 31;  ///< impulse on the torso's centre of mass in the next step, world, N s: 3
  static constexpr int joints = 34;  ///< first row that depends on the robot

  explicit Rows(const Model& model)
      : links(static_cast<int>(model.links.size())),
        speed(angle + links),
        joint_impulse(speed + links),
        point_impulse(joint_impulse + links),
        pose(point_impulse + 3 * static_cast<int>(model.points.size())),
        touch(pose + pose_size * links),
        count(touch + model.legs) {}

  int links;
  int angle = joints;  ///< by link, rad
  int speed;           ///< by link, rad/s
  int joint_impulse;   ///< by link: of motor or stop in the step before, N m s
  int point_impulse;   ///< by point: of the ground in the step before along z, y, x, N s: 3
  int pose;            ///< by link: axes of its frame as columns (9), origin (3), axis of its joint (3), and
                       ///< origin × axis (3), torso axes
  int touch;           ///< by leg: in the pose at the beginning of the step before
  int count;

  static constexpr int pose_size = 18;
};

}  // namespace amble::physics::batch
