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

/// Index of each quantity among the rows that outlive a step. Torso axes are those of the torso's frame;
/// positions in them are relative to the robot's centre of mass.
struct StateRows {
  // The state itself.
  static constexpr int com = 0;               ///< centre of mass, world, m: 3
  static constexpr int com_compensation = 3;  ///< what rounding has taken from com (two-sum), m: 3
  static constexpr int rotation = 6;   ///< of the torso, quaternion w, x, y, z, torso axes → world: 4
  static constexpr int velocity = 10;  ///< of the centre of mass, world, m/s: 3
  static constexpr int angular_momentum = 13;  ///< about the centre of mass, world, kg m²/s: 3
  // Flags, 0 or 1.
  static constexpr int active = 16;  ///< placed and not retired
  static constexpr int healthy = 17;
  // Derived from the state.
  static constexpr int world_axes = 18;    ///< the world's x, y, z axes in torso axes: 9
  static constexpr int torso_origin = 27;  ///< of the torso's frame, torso axes, m: 3
  static constexpr int contacts = 30;      ///< number of touching points at the beginning of the last step
  // Set from outside.
  static constexpr int push_impulse = 31;  ///< on the torso's centre of mass in the next step, world, N s: 3
  static constexpr int joints = 34;        ///< first row that depends on the robot

  explicit StateRows(const Model& model)
      : links(static_cast<int>(model.links.size())),
        speed(angle + links),
        joint_impulse(speed + links),
        point_impulse(joint_impulse + static_cast<int>(model.joint_rows.size())),
        pose(point_impulse + 3 * static_cast<int>(model.points.size())),
        touch(pose + pose_size * links),
        count(touch + model.legs) {}

  int links;
  int angle = joints;  ///< by link, rad
  int speed;           ///< by link, rad/s
  int joint_impulse;   ///< by joint row (Model::joint_rows) in the last step, N m s
  int point_impulse;   ///< by point: of the ground in the last step along the world's z, y, x (on uneven
                       ///< ground along its normal and the directions of friction), N s: 3
  int pose;            ///< by link, torso axes: axes of its frame as columns (9), its origin (3), and the
                       ///< joint's motion subspace: its axis (3) and origin × axis (3)
  int touch;           ///< by leg, 0 or 1: in the pose at the beginning of the last step
  int count;

  static constexpr int pose_size = 18;
};

}  // namespace amble::physics::batch
