#include "amble/physics/batch/lockstep_state.hpp"

#include "amble/core/index.hpp"

namespace amble::physics::batch {

LockstepState::LockstepState(const Model& model, const StateRows& layout)
    : model_(model), layout_(layout), rows_(to_index(layout.count)) {
  sensors_.joint_angle_rad = LaneArray(layout.links, lanes);
  sensors_.touch = LaneArray(model.legs, lanes);
  sensors_.attitude_rad = LaneArray(3, lanes);
}

void LockstepState::put(int row, int lane, Vec3 v) {
  at(row, lane) = static_cast<float>(v.x);
  at(row + 1, lane) = static_cast<float>(v.y);
  at(row + 2, lane) = static_cast<float>(v.z);
}

Quat LockstepState::rotation(int lane) const {
  const Vec3 q = vec3(StateRows::rotation + 1, lane);
  return {number(StateRows::rotation, lane), q.x, q.y, q.z};
}

Vec3 LockstepState::to_world(int lane, Vec3 v) const {
  return {dot(vec3(StateRows::world_axes, lane), v), dot(vec3(StateRows::world_axes + 3, lane), v),
          dot(vec3(StateRows::world_axes + 6, lane), v)};
}

void LockstepState::set_state(int lane, const RobotState& state) {
  put(StateRows::com, lane, state.com_m);
  put(StateRows::com_compensation, lane, state.com_m - vec3(StateRows::com, lane));
  at(StateRows::rotation, lane) = static_cast<float>(state.rotation.w);
  put(StateRows::rotation + 1, lane, {state.rotation.x, state.rotation.y, state.rotation.z});
  put(StateRows::velocity, lane, state.velocity_m_s);
  put(StateRows::angular_momentum, lane, state.angular_momentum_kg_m2_s);
  for (int l = 0; l < layout_.links; ++l) {
    const std::size_t joint = to_index(model_.links[to_index(l)].joint);
    at(layout_.angle + l, lane) = static_cast<float>(state.angle_rad[joint]);
    at(layout_.speed + l, lane) = static_cast<float>(state.speed_rad_s[joint]);
  }
  for (int r = layout_.joint_impulse; r < layout_.pose; ++r) at(r, lane) = 0.0f;
}

RobotState LockstepState::state(int lane) const {
  RobotState state{vec3(StateRows::com, lane) + vec3(StateRows::com_compensation, lane),
                   rotation(lane),
                   vec3(StateRows::velocity, lane),
                   vec3(StateRows::angular_momentum, lane),
                   std::vector<double>(to_index(layout_.links)),
                   std::vector<double>(to_index(layout_.links))};
  for (int l = 0; l < layout_.links; ++l) {
    const std::size_t joint = to_index(model_.links[to_index(l)].joint);
    state.angle_rad[joint] = number(layout_.angle + l, lane);
    state.speed_rad_s[joint] = number(layout_.speed + l, lane);
  }
  return state;
}

void LockstepState::copy(int to, const LockstepState& others, int from) {
  for (int row = 0; row < layout_.count; ++row) at(row, to) = others.at(row, from);
  const auto copy_lane = [&](LaneArray& target, const LaneArray& source) {
    for (int row = 0; row < target.rows(); ++row) target.at(row, to) = source.at(row, from);
  };
  copy_lane(sensors_.joint_angle_rad, others.sensors_.joint_angle_rad);
  copy_lane(sensors_.touch, others.sensors_.touch);
  copy_lane(sensors_.attitude_rad, others.sensors_.attitude_rad);
}

}  // namespace amble::physics::batch
