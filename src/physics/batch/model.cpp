#include "amble/physics/batch/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/sensors.hpp"

namespace amble::physics::batch {
namespace {

using robot::Body;
using robot::Geom;
using robot::Joint;
using robot::Pose;
using robot::RobotSpec;

Float3 narrow(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sweeps of the solver: what the robot's file says, or what the paper's quadruped needs.
int sweeps_of(const robot::Contact& contact) {
  if (contact.sweeps > 0) return contact.sweeps;
  return std::isinf(contact.friction) ? 10 : 14;
}

Pose inverse(const Pose& pose) {
  const Quat back = conjugate(pose.rotation);
  return {-rotate(back, pose.position_m), back};
}

/// Inertia of a body about its centre of mass, I = R diag(moments) Rᵀ, in torso axes of the start pose.
/// `pose` (of the body) and `origin` (of the link's frame) are relative to the torso's frame.
MassPart mass_part(const Body& body, const Pose& pose, Vec3 origin) {
  const Quat principal = pose.rotation * body.inertia_rotation;
  const std::array<Vec3, 3> axes{rotate(principal, {1, 0, 0}), rotate(principal, {0, 1, 0}),
                                 rotate(principal, {0, 0, 1})};
  const Vec3 moments = body.inertia_kg_m2;
  const auto element = [&](double Vec3::*r, double Vec3::*c) {
    return moments.x * axes[0].*r * axes[0].*c + moments.y * axes[1].*r * axes[1].*c +
           moments.z * axes[2].*r * axes[2].*c;
  };
  constexpr auto x = &Vec3::x, y = &Vec3::y, z = &Vec3::z;
  return {.mass_kg = static_cast<float>(body.mass_kg),
          .com_m = narrow(pose * body.com_m - origin),
          .moments_kg_m2 = narrow({element(x, x), element(y, y), element(z, z)}),
          .products_kg_m2 = narrow({element(x, y), element(x, z), element(y, z)})};
}

class Builder {
 public:
  Builder(const RobotSpec& robot, Model& model) : robot_(robot), model_(model) {
    const auto poses = robot::start_poses(robot);
    for (const Pose& pose : poses) poses_.push_back(inverse(poses[0]) * pose);
    frames_.resize(robot.bodies.size());
  }

  void build() {
    model_.torso = mass_part(robot_.bodies[0], poses_[0], {});
    for (int body : children(0)) add_chain(body);
    model_.first_geom.push_back(0);
    add_geoms(-1);
    for (int c = 0; c < static_cast<int>(model_.chains.size()); ++c) add_geoms(c);
  }

 private:
  struct LinkFrame {
    int chain = -1, link = -1;  ///< −1: the torso
    Vec3 origin_m;              ///< of the link's frame, relative to the torso, in the start pose
  };

  std::vector<int> children(int parent) const {
    std::vector<int> found;
    for (int b = 1; b < static_cast<int>(robot_.bodies.size()); ++b)
      if (robot_.bodies[to_index(b)].parent == parent) found.push_back(b);
    return found;
  }

  void add_chain(int body) {
    Chain chain{.first = static_cast<int>(model_.links.size()),
                .count = 0,
                .first_row = static_cast<int>(model_.joint_rows.size())};
    add_branch(body, -1, {});
    chain.count = static_cast<int>(model_.links.size()) - chain.first;
    if (chain.count > Model::max_chain)
      fail(ExitCode::bad_input,
           "the batch engine cannot simulate more than {} joints in one chain, as at body '{}': use engine "
           "ode",
           Model::max_chain, robot_.bodies[to_index(body)].name);
    for (const bool friction : {false, true})
      for (int l = 0; l < chain.count; ++l)
        if (!friction || model_.links[to_index(chain.first + l)].friction_loss_nm > 0.0f)
          model_.joint_rows.push_back({l, friction});
    chain.row_count = static_cast<int>(model_.joint_rows.size()) - chain.first_row;
    model_.chains.push_back(chain);
  }

  /// Adds the links of a body and of all that it carries. `parent` is the link, in the chain to come, whose
  /// frame has its origin at `before`, relative to the torso.
  void add_branch(int body, int parent, Vec3 before) {
    const int chain = static_cast<int>(model_.chains.size());
    const int first = chain == 0 ? 0 : model_.chains.back().first + model_.chains.back().count;
    const auto next_link = [&] { return static_cast<int>(model_.links.size()) - first; };
    const int first_link = next_link();
    for (const int joint : robot_.joints_of_body(body)) {
      before = add_link(joint, before);
      model_.links.back().parent = parent;
      parent = next_link() - 1;
    }
    const int own_links = next_link() - first_link;
    Link& last = model_.links.back();
    last.has_mass = true;
    last.body = mass_part(robot_.bodies[to_index(body)], poses_[to_index(body)], before);
    frames_[to_index(body)] = {chain, parent, before};
    for (const int child : children(body)) add_branch(child, parent, before);
    for (int l = 0; l < own_links; ++l) model_.links[to_index(first + first_link + l)].last = next_link() - 1;
  }

  Vec3 add_link(int index, Vec3 before) {
    const Joint& joint = robot_.joints[to_index(index)];
    const Pose& pose = poses_[to_index(joint.body)];
    const Vec3 origin = pose * joint.anchor_m;
    const Vec3 axis = rotate(pose.rotation, joint.axis);
    const robot::Servo servo = joint.acting_servo();
    Link link{.joint = index,
              .from_parent_m = narrow(origin - before),
              .direction = narrow(axis),
              .body = {},
              .lower_rad = static_cast<float>(joint.lower_rad),
              .upper_rad = static_cast<float>(joint.upper_rad),
              .has_motor = joint.has_motor(),
              .rest_rad = static_cast<float>(joint.rest_rad),
              .velocity_servo = servo.mode == robot::ServoMode::velocity,
              .gain_per_s = static_cast<float>(servo.gain_per_s),
              .max_torque_nm = static_cast<float>(servo.max_torque_nm),
              .kp_nm_per_rad = static_cast<float>(servo.kp_nm_per_rad),
              .kd_nm_s_per_rad = static_cast<float>(servo.kd_nm_s_per_rad),
              .armature_kg_m2 = static_cast<float>(joint.armature_kg_m2),
              .damping_nm_s_per_rad = static_cast<float>(joint.damping_nm_s_per_rad),
              .friction_loss_nm = static_cast<float>(joint.friction_loss_nm)};
    const std::array<double, 3> parts{axis.x, axis.y, axis.z};
    for (int k = 0; k < 3; ++k) {
      if (std::abs(parts[to_index(k)]) < 1.0 - 1e-12) continue;
      link.axis = k;
      link.sign = parts[to_index(k)] > 0.0 ? 1.0f : -1.0f;
    }
    model_.links.push_back(link);
    return origin;
  }

  void add_geoms(int chain) {
    for (int g = 0; g < static_cast<int>(robot_.geoms.size()); ++g) {
      const Geom& geom = robot_.geoms[to_index(g)];
      if (geom.collides && frames_[to_index(geom.body)].chain == chain) add_geom(g);
    }
    model_.first_geom.push_back(static_cast<int>(model_.geoms.size()));
  }

  void add_geom(int index) {
    const Geom& geom = robot_.geoms[to_index(index)];
    const LinkFrame& frame = frames_[to_index(geom.body)];
    const Pose pose = poses_[to_index(geom.body)] * Pose{geom.position_m, geom.rotation};
    PointGroup group{.first = static_cast<int>(model_.points.size()),
                     .centre_m = narrow(pose.position_m - frame.origin_m),
                     .bounding_radius_m = static_cast<float>(robot::bounding_radius_m(geom))};
    for (const robot::CollisionPoint& from : robot::collision_points(geom)) {
      Point point{.chain = frame.chain,
                  .link = frame.link,
                  .position_m = narrow(pose * from.position_m - frame.origin_m),
                  .radius_m = static_cast<float>(from.radius_m),
                  .rim_radius_m = static_cast<float>(from.rim_radius_m)};
      if (from.rim_radius_m > 0.0) {
        point.rim_axis = narrow(rotate(pose.rotation, {0.0, 0.0, 1.0}));
        point.rim_start = narrow(rotate(pose.rotation, {1.0, 0.0, 0.0}));
        point.rim_cosine = static_cast<float>(std::cos(from.rim_angle_rad));
        point.rim_sine = static_cast<float>(std::sin(from.rim_angle_rad));
      }
      point.field = static_cast<int>(std::ranges::lower_bound(radii_m_, from.radius_m) - radii_m_.begin());
      model_.points.push_back(point);
    }
    group.bounding_radius_m *= 1.0001f;  // margin for rounding
    group.count = static_cast<int>(model_.points.size()) - group.first;
    for (std::size_t l = 0; l < robot_.legs.size(); ++l)
      if (robot_.legs[l].has_foot_geom(index)) group.leg = static_cast<int>(l);
    const auto same_leg = [&](const PointGroup& other) { return other.leg == group.leg; };
    group.first_of_foot = std::ranges::none_of(model_.geoms, same_leg);
    model_.geoms.push_back(group);
  }

  const RobotSpec& robot_;
  Model& model_;
  std::vector<Pose> poses_;  ///< of all bodies, relative to the torso, in the start pose
  const std::vector<double> radii_m_ = robot::contact_radii_m(robot_);
  std::vector<LinkFrame> frames_;  ///< of all bodies: the link that carries each
};

}  // namespace

Model::Model(const RobotSpec& robot)
    : mass_kg(static_cast<float>(robot.total_mass_kg())),
      gravity_m_s2(narrow(robot.gravity_m_s2)),
      friction(static_cast<float>(robot.contact.friction)),
      erp(static_cast<float>(robot.contact.erp)),
      cfm_s_per_kg(static_cast<float>(robot.contact.cfm_s_per_kg)),
      // The bounds of a friction pyramid change in every sweep: over-relaxed, resting feet would chatter.
      joint_relaxation(1.4f),
      contact_relaxation(std::isinf(friction) ? 1.4f : 1.0f),
      iterations(sweeps_of(robot.contact)),
      legs(static_cast<int>(robot.legs.size())) {
  if (robot.self_collision)
    fail(ExitCode::bad_input,
         "the batch engine knows no self-collision: set self_collision = false, or use engine ode");
  if (gravity_m_s2.x != 0.0f || gravity_m_s2.y != 0.0f) {
    tilted = true;
    const Quat rotation = robot::horizontal_frame(robot.gravity_m_s2);
    level[0] = narrow(rotate(rotation, {1.0, 0.0, 0.0}));
    level[1] = narrow(rotate(rotation, {0.0, 1.0, 0.0}));
    level[2] = narrow(rotate(rotation, {0.0, 0.0, 1.0}));
  }
  if (const Quat own = robot.bodies[0].rotation; own != Quat()) {
    turned = true;
    start[0] = narrow(rotate(conjugate(own), {1.0, 0.0, 0.0}));
    start[1] = narrow(rotate(conjugate(own), {0.0, 1.0, 0.0}));
    start[2] = narrow(rotate(conjugate(own), {0.0, 0.0, 1.0}));
  }
  Builder(robot, *this).build();
  for (const Chain& chain : chains) {
    longest_chain = std::max(longest_chain, chain.count);
    equal_chains = equal_chains && chain.count == chains[0].count;
    joint_friction = joint_friction || chain.row_count > chain.count;
    for (int l = chain.count - 1; l >= 0; --l) {
      Link& link = links[to_index(chain.first + l)];
      if (link.has_mass) link.outer_mass_kg += link.body.mass_kg;
      if (link.parent >= 0) links[to_index(chain.first + link.parent)].outer_mass_kg += link.outer_mass_kg;
      equal_chains = equal_chains && link.parent == l - 1;
    }
  }
}

}  // namespace amble::physics::batch
