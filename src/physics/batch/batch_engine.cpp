#include "amble/physics/batch/batch_engine.hpp"

#include <algorithm>
#include <array>

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"
#include "amble/physics/batch/step.hpp"

namespace amble::physics {
namespace {

using batch::Row;
using batch::Rows;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

class LockstepEngine final : public BatchEngine {
 public:
  LockstepEngine(const morphology::RobotSpec& robot, const EngineSettings& settings)
      : model_(robot),
        rows_(model_),
        workspace_(model_),
        root_com_m_(robot.bodies[0].com_m),
        mass_kg_(robot.total_mass_kg()),
        state_(at(rows_.count)),
        batch_{model_,
               rows_,
               state_.data(),
               workspace_,
               sensors_,
               static_cast<float>(settings.timestep_s),
               settings.iterations} {
    sensors_.joint_angle_rad = LaneArray(rows_.links, batch::lanes);
    sensors_.touch = LaneArray(model_.legs, batch::lanes);
    sensors_.attitude_rad = LaneArray(3, batch::lanes);
    find_start(robot);
  }

  int lanes() const override { return batch::lanes; }

  void place(int lane) override {
    check_lane(lane);
    for (int r = 0; r < rows_.count; ++r) at_row(r, lane) = start_[at(r)];
    at_row(Rows::active, lane) = at_row(Rows::healthy, lane) = 1.0f;
    for (int j = 0; j < rows_.links; ++j) sensors_.joint_angle_rad.at(j, lane) = 0.0f;
    for (int leg = 0; leg < model_.legs; ++leg) sensors_.touch.at(leg, lane) = start_[at(rows_.touch + leg)];
    for (int row = 0; row < 3; ++row) sensors_.attitude_rad.at(row, lane) = start_attitude_rad_[at(row)];
  }

  void retire(int lane) override {
    check_lane(lane);
    at_row(Rows::active, lane) = 0.0f;
  }

  void step(const LaneArray& targets_rad) override {
    AMBLE_CHECK(targets_rad.rows() == rows_.links && targets_rad.lanes() == batch::lanes, "targets");
    batch::step(batch_, targets_rad);
  }

  bool healthy(int lane) const override {
    check_lane(lane);
    return at_row(Rows::healthy, lane) == 1.0f;
  }

  const SensorFrame& sensors() const override { return sensors_; }

  RootPose root_pose(int lane) const override {
    return {com_m(lane) + to_world(lane, vec3(Rows::origin, lane)), rotation(lane)};
  }
  Vec3 root_com_m(int lane) const override {
    return com_m(lane) + to_world(lane, vec3(Rows::origin, lane) + root_com_m_);
  }
  Vec3 com_m(int lane) const override { return vec3(Rows::com, lane) + vec3(Rows::com_rest, lane); }
  Vec3 momentum(int lane) const override { return mass_kg_ * vec3(Rows::velocity, lane); }

  std::uint64_t state_hash(int lane) const override {
    check_lane(lane);
    std::vector<float> values;
    values.reserve(at(Rows::active + 2 * rows_.links));
    for (int r = 0; r < Rows::active; ++r) values.push_back(at_row(r, lane));
    for (int r = rows_.angle; r < rows_.joint_impulse; ++r) values.push_back(at_row(r, lane));
    return hash_span<float>(values);
  }

  void set_state(int lane, const BatchState& state) override {
    AMBLE_CHECK(at_row(Rows::active, lane) == 1.0f, "a lane is placed before its state is set");
    put_state(lane, state);
    batch::derive(batch_);
  }

  int contacts(int lane) const override { return static_cast<int>(at_row(Rows::contacts, lane)); }

  BatchState state(int lane) const override {
    BatchState state{com_m(lane),
                     rotation(lane),
                     vec3(Rows::velocity, lane),
                     vec3(Rows::spin, lane),
                     std::vector<double>(at(rows_.links)),
                     std::vector<double>(at(rows_.links))};
    for (int l = 0; l < rows_.links; ++l) {
      const int joint = model_.links[at(l)].joint;
      state.angle_rad[at(joint)] = number(rows_.angle + l, lane);
      state.speed_rad_s[at(joint)] = number(rows_.speed + l, lane);
    }
    return state;
  }

 private:
  static void check_lane(int lane) {
    AMBLE_CHECK(lane >= 0 && lane < batch::lanes, "the batch engine has 16 lanes");
  }
  float& at_row(int row, int lane) { return state_[at(row)].lane[at(lane)]; }
  float at_row(int row, int lane) const { return state_[at(row)].lane[at(lane)]; }
  double number(int row, int lane) const { return static_cast<double>(at_row(row, lane)); }
  Vec3 vec3(int row, int lane) const {
    check_lane(lane);
    return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
  }
  Quat rotation(int lane) const {
    const Vec3 q = vec3(Rows::rotation + 1, lane);
    return {number(Rows::rotation, lane), q.x, q.y, q.z};
  }
  Vec3 to_world(int lane, Vec3 v) const {
    return {dot(vec3(Rows::axes, lane), v), dot(vec3(Rows::axes + 3, lane), v),
            dot(vec3(Rows::axes + 6, lane), v)};
  }

  void put(int row, int lane, Vec3 v) {
    at_row(row, lane) = static_cast<float>(v.x);
    at_row(row + 1, lane) = static_cast<float>(v.y);
    at_row(row + 2, lane) = static_cast<float>(v.z);
  }

  void put_state(int lane, const BatchState& state) {
    put(Rows::com, lane, state.com_m);
    put(Rows::com_rest, lane, state.com_m - vec3(Rows::com, lane));
    at_row(Rows::rotation, lane) = static_cast<float>(state.rotation.w);
    put(Rows::rotation + 1, lane, {state.rotation.x, state.rotation.y, state.rotation.z});
    put(Rows::velocity, lane, state.velocity_m_s);
    put(Rows::spin, lane, state.spin_kg_m2_s);
    for (int l = 0; l < rows_.links; ++l) {
      const int joint = model_.links[at(l)].joint;
      at_row(rows_.angle + l, lane) = static_cast<float>(state.angle_rad[at(joint)]);
      at_row(rows_.speed + l, lane) = static_cast<float>(state.speed_rad_s[at(joint)]);
    }
    for (int r = rows_.joint_impulse; r < rows_.pose; ++r) at_row(r, lane) = 0.0f;
  }

  /// Works out lane 0 in the start pose, at rest, and keeps a copy of all its rows.
  void find_start(const morphology::RobotSpec& robot) {
    at_row(Rows::active, 0) = 1.0f;
    const std::vector<double> still(robot.joints.size(), 0.0);
    const morphology::Body& root = robot.bodies[0];
    put_state(0, {root.position_m, root.rotation, {}, {}, still, still});
    batch::derive(batch_);
    // That put the centre of mass where the root's frame belongs.
    const Vec3 com = root.position_m - to_world(0, vec3(Rows::origin, 0));
    put_state(0, {com, root.rotation, {}, {}, still, still});
    batch::derive(batch_);
    for (const Row& row : state_) start_.push_back(row.lane[0]);
    for (int row = 0; row < 3; ++row) start_attitude_rad_[at(row)] = sensors_.attitude_rad.at(row, 0);
    for (Row& row : state_) row.lane.fill(0.0f);
    for (int lane = 0; lane < batch::lanes; ++lane) {
      place(lane);
      retire(lane);
    }
  }

  const batch::Model model_;
  const Rows rows_;
  batch::Workspace workspace_;
  const Vec3 root_com_m_;
  const double mass_kg_;
  std::vector<Row> state_;
  SensorFrame sensors_;
  batch::Batch batch_;
  std::vector<float> start_;  ///< by row: of a robot in its start pose
  std::array<float, 3> start_attitude_rad_{};
};

}  // namespace

std::unique_ptr<BatchEngine> make_batch_engine(const morphology::RobotSpec& robot,
                                               const EngineSettings& settings) {
  return std::make_unique<LockstepEngine>(robot, settings);
}

}  // namespace amble::physics
