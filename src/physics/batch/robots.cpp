#include "amble/physics/batch/robots.hpp"

#include "amble/core/index.hpp"

namespace amble::physics::batch {

Robots::Robots(const Model& model, const Rows& layout)
    : model_(model), layout_(layout), rows_(to_index(layout.count)) {
  sensors_.joint_angle_rad = LaneArray(layout.links, lanes);
  sensors_.touch = LaneArray(model.legs, lanes);
  sensors_.attitude_rad = LaneArray(3, lanes);
}

void Robots::put(int row, int lane, Vec3 v) {
  at(row, lane) = static_cast<float>(v.x);
  at(row + 1, lane) = static_cast<float>(v.y);
  at(row + 2, lane) = static_cast<float>(v.z);
}

Quat Robots::rotation(int lane) const {
  const Vec3 q = vec3(Rows::rotation + 1, lane);
  return {number(Rows::rotation, lane), q.x, q.y, q.z};
}

Vec3 Robots::to_world(int lane, Vec3 v) const {
  return {dot(vec3(Rows::axes, lane), v), dot(vec3(Rows::axes + 3, lane), v),
          dot(vec3(Rows::axes + 6, lane), v)};
}

void Robots::put_state(int lane, const BatchState& state) {
  put(Rows::com, lane, state.com_m);
  put(Rows::com_rest, lane, state.com_m - vec3(Rows::com, lane));
  at(Rows::rotation, lane) = static_cast<float>(state.rotation.w);
  put(Rows::rotation + 1, lane, {state.rotation.x, state.rotation.y, state.rotation.z});
  put(Rows::velocity, lane, state.velocity_m_s);
  put(Rows::spin, lane, state.spin_kg_m2_s);
  for (int l = 0; l < layout_.links; ++l) {
    const std::size_t joint = to_index(model_.links[to_index(l)].joint);
    at(layout_.angle + l, lane) = static_cast<float>(state.angle_rad[joint]);
    at(layout_.speed + l, lane) = static_cast<float>(state.speed_rad_s[joint]);
  }
  for (int r = layout_.joint_impulse; r < layout_.pose; ++r) at(r, lane) = 0.0f;
}

BatchState Robots::state(int lane) const {
  BatchState state{vec3(Rows::com, lane) + vec3(Rows::com_rest, lane),
                   rotation(lane),
                   vec3(Rows::velocity, lane),
                   vec3(Rows::spin, lane),
                   std::vector<double>(to_index(layout_.links)),
                   std::vector<double>(to_index(layout_.links))};
  for (int l = 0; l < layout_.links; ++l) {
    const std::size_t joint = to_index(model_.links[to_index(l)].joint);
    state.angle_rad[joint] = number(layout_.angle + l, lane);
    state.speed_rad_s[joint] = number(layout_.speed + l, lane);
  }
  return state;
}

void Robots::copy(int to, const Robots& others, int from) {
  for (int row = 0; row < layout_.count; ++row) at(row, to) = others.at(row, from);
  const auto copy_lane = [&](LaneArray& target, const LaneArray& source) {
    for (int row = 0; row < target.rows(); ++row) target.at(row, to) = source.at(row, from);
  };
  copy_lane(sensors_.joint_angle_rad, others.sensors_.joint_angle_rad);
  copy_lane(sensors_.touch, others.sensors_.touch);
  copy_lane(sensors_.attitude_rad, others.sensors_.attitude_rad);
}

}  // namespace amble::physics::batch
