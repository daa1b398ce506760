#pragma once

#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::physics::batch {

struct Float3 {
  float x = 0.0f, y = 0.0f, z = 0.0f;
};

/// Mass and inertia of a body in the axes of its link's frame.
struct MassPart {
  float mass_kg = 0.0f;
  Float3 com_m;
  Float3 moments_kg_m2;   ///< xx, yy, zz of the inertia tensor about the centre of mass
  Float3 products_kg_m2;  ///< its elements xy, xz, yz
};

/// One hinge and the body that it moves. The origin of a link's frame is the joint's anchor; in the start
/// pose its axes are those of the torso. A body with two hinges is two links, the first without mass.
struct Link {
  int joint = 0;         ///< index in control order
  int parent = -1;       ///< its parent's index in the chain; −1: the torso
  int last = 0;          ///< index in the chain of the last link that it carries; itself if it carries none
  Float3 from_parent_m;  ///< origin in the frame of the parent
  int axis = 3;          ///< 0, 1, 2: the joint's axis is x, y, z of its frame; 3: it is `direction`
  float sign = 1.0f;     ///< −1: it is the negative x, y or z
  Float3 direction;
  bool has_mass = false;
  MassPart body;
  float outer_mass_kg = 0.0f;  ///< composite: of this link and all that it carries
  float lower_rad = 0.0f, upper_rad = 0.0f;
  /// Without a motor the servo is a spring, whose target is always `rest_rad`, whatever the stops.
  bool has_motor = true;
  float rest_rad = 0.0f;
  bool velocity_servo = true;
  float gain_per_s = 0.0f, max_torque_nm = 0.0f, kp_nm_per_rad = 0.0f, kd_nm_s_per_rad = 0.0f;
  float armature_kg_m2 = 0.0f, damping_nm_s_per_rad = 0.0f, friction_loss_nm = 0.0f;
};

/// A constraint row of a joint: of its motor and stops, or of its dry friction.
struct JointRow {
  int link = 0;  ///< index in its chain
  bool friction = false;
};

/// The links on one hinge of the torso, and all that they carry, parents before children, the descendants
/// of a link directly after it: from the torso outwards if the chain does not branch.
struct Chain {
  int first = 0, count = 0;          ///< links
  int first_row = 0, row_count = 0;  ///< joint rows: one per link in order, then those of friction
};

/// A sphere (or, with radius 0, a corner) that can touch the ground; or a point of a cylinder's rim: of each
/// rim three, the lowest and those a third of the circle from it, which carry a cylinder that stands upright.
struct Point {
  int chain = -1;     ///< −1: on the torso
  int link = -1;      ///< index in its chain
  Float3 position_m;  ///< of a rim: its centre
  float radius_m = 0.0f;
  float rim_radius_m = 0.0f;  ///< 0: no rim
  Float3 rim_axis = {},
         rim_start = {};  ///< unit vectors: the cylinder's axis, and one at a right angle to it
  float rim_cosine = 1.0f, rim_sine = 0.0f;  ///< of the angle from the lowest point
  int field = 0;  ///< index among the fields of uneven ground (ground::Ground::fields)
};

/// The points of one geom, and a sphere that encloses them.
struct PointGroup {
  int first = 0, count = 0;
  Float3 centre_m;  ///< of the sphere, in the link's frame
  float bounding_radius_m = 0.0f;
  int leg = -1;               ///< the leg whose foot it is part of, −1: none
  bool first_of_foot = true;  ///< before all others of its foot
};

/// A robot in the coordinates of the batch engine: a floating torso with chains of hinges, float32.
/// Throws UserError for what the engine cannot simulate.
struct Model {
  explicit Model(const robot::RobotSpec& robot);

  std::vector<Chain> chains;
  std::vector<Link> links;           ///< chain by chain
  std::vector<JointRow> joint_rows;  ///< chain by chain
  std::vector<Point> points;         ///< the torso's first, then chain by chain
  std::vector<PointGroup> geoms;     ///< in the order of their points
  std::vector<int> first_geom;       ///< index into geoms: of the torso, of each chain, then one past the end
  MassPart torso;                    ///< in the torso's frame
  float mass_kg = 0.0f;              ///< of the whole robot
  Float3 gravity_m_s2;
  /// Where gravity is not along −z: the axes of a level frame, whose z is up, in the world; attitude is
  /// measured in it.
  bool tilted = false;
  Float3 level[3];
  /// Where the root's axes are not the world's in the start pose: those of the world in the root's frame;
  /// attitude is measured from that pose.
  bool turned = false;
  Float3 start[3];
  float friction = 0.0f;  ///< may be infinite
  float erp = 0.0f, cfm_s_per_kg = 0.0f;
  /// Over-relaxation ω and number of sweeps of the constraint solver, chosen by the friction (docs/BATCH.md,
  /// "Solver").
  float joint_relaxation = 1.0f, contact_relaxation = 1.0f;
  int iterations = 0;
  int legs = 0;
  int longest_chain = 0;
  bool equal_chains = true;     ///< all have longest_chain links and do not branch
  bool joint_friction = false;  ///< some joint has dry friction

  static constexpr int max_chain = 24;
};

}  // namespace amble::physics::batch
