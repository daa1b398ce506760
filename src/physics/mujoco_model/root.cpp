#include "amble/physics/mujoco_model/root.hpp"

#include <algorithm>
#include <cmath>

#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::physics::mujoco_model {
namespace {

using morphology::quat;
using morphology::vec3;

/// By how much q turns about a unit axis, −π … π (its twist).
double twist_rad(const Quat& q, Vec3 axis) {
  const double along = q.x * axis.x + q.y * axis.y + q.z * axis.z;
  return 2.0 * std::atan2(q.w < 0.0 ? -along : along, std::abs(q.w));
}

}  // namespace

Root::Root(const mjModel& model, int body)
    : body_(body),
      joint_(model.body_jntadr[body]),
      joints_(model.body_jntnum[body]),
      position_(model.jnt_qposadr[joint_]),
      dof_(model.body_dofadr[body]),
      dofs_(model.body_dofnum[body]),
      free_(model.jnt_type[joint_] == mjJNT_FREE) {}

void Root::place(const mjModel* model, const RootPose& pose, mjData* data) const {
  if (free_) {
    const auto& [position_m, rotation] = pose;
    const mjtNum root[] = {position_m.x, position_m.y, position_m.z, rotation.w,
                           rotation.x,   rotation.y,   rotation.z};
    std::ranges::copy(root, data->qpos + position_);
    return;
  }
  const auto of_type = [&](int type, const auto& set) {
    for (int j = joint_; j < joint_ + joints_; ++j)
      if (model->jnt_type[j] == type) set(j, data->qpos[model->jnt_qposadr[j]]);
  };
  // Each hinge takes what is still missing about its axis in the world.
  of_type(mjJNT_HINGE, [&](int j, mjtNum& angle_rad) {
    mj_kinematics(model, data);
    const Quat missing = pose.rotation * conjugate(quat(data->xquat + 4 * body_));
    angle_rad += twist_rad(missing, vec3(data->xaxis + 3 * j));
  });
  of_type(mjJNT_SLIDE, [&](int j, mjtNum& way_m) {
    mj_kinematics(model, data);
    way_m += dot(pose.position_m - vec3(data->xpos + 3 * body_), vec3(data->xaxis + 3 * j));
  });
  mj_kinematics(model, data);
}

void Root::move(const mjModel* model, Vec3 velocity_m_s, Vec3 angular_velocity_rad_s, mjData* data) const {
  if (free_) {
    // A free joint's angular velocity is in the axes of its body.
    const Vec3 v = velocity_m_s, w = rotate(conjugate(pose(*data).rotation), angular_velocity_rad_s);
    const mjtNum root[] = {v.x, v.y, v.z, w.x, w.y, w.z};
    std::ranges::copy(root, data->qvel + dof_);
    return;
  }
  mj_kinematics(model, data);
  mj_comPos(model, data);
  for (const int type : {mjJNT_HINGE, mjJNT_SLIDE})
    for (int j = joint_; j < joint_ + joints_; ++j) {
      if (model->jnt_type[j] != type) continue;
      const RootMotion now = motion(model, data);
      const Vec3 missing = type == mjJNT_HINGE ? angular_velocity_rad_s - now.angular_velocity_rad_s
                                               : velocity_m_s - now.velocity_m_s;
      data->qvel[model->jnt_dofadr[j]] += dot(missing, vec3(data->xaxis + 3 * j));
    }
}

RootPose Root::pose(const mjData& data) const {
  if (!free_) return {vec3(data.xpos + 3 * body_), quat(data.xquat + 4 * body_)};
  const mjtNum* const q = data.qpos + position_;
  return {vec3(q), quat(q + 3)};
}

RootMotion Root::motion(const mjModel* model, mjData* data) const {
  if (free_) {
    const mjtNum* const speed = data->qvel + dof_;
    return {vec3(speed), rotate(pose(*data).rotation, vec3(speed + 3))};
  }
  mj_comVel(model, data);
  mjtNum turn_and_move[6];
  mj_objectVelocity(model, data, mjOBJ_XBODY, body_, turn_and_move, 0);
  return {vec3(turn_and_move + 3), vec3(turn_and_move)};
}

}  // namespace amble::physics::mujoco_model
