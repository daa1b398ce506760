#include "amble/physics/batch/batch_engine.hpp"

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/physics/batch/lockstep_state.hpp"
#include "amble/physics/batch/state_rows.hpp"
#include "amble/physics/batch/step.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/velocity.hpp"

namespace amble::physics::batch {
namespace {

robot::WholeMotion whole_motion(const robot::RobotSpec& robot, const RootPose& root,
                                const robot::Twist& twist, const robot::JointStates& joints) {
  const auto poses = robot::poses_at(robot, {root.position_m, root.rotation}, joints.angle_rad);
  return robot::whole_motion(robot, poses, robot::twists_at(robot, poses, twist, joints));
}

/// Solves x a + y b + z c = v by Cramer's rule.
Vec3 solve(Vec3 a, Vec3 b, Vec3 c, Vec3 v) {
  const double scale = 1.0 / dot(a, cross(b, c));
  return {scale * dot(v, cross(b, c)), scale * dot(a, cross(v, c)), scale * dot(a, cross(b, v))};
}

}  // namespace

MovingPose motion_of(const robot::RobotSpec& robot, const RootPose& root, const RobotState& state) {
  const std::vector<double> still(state.speed_rad_s.size(), 0.0);
  // L and v_com are linear in the root's twist and the joints' speeds; L does not depend on the root's
  // velocity, so L − L(speeds) = I ω first, then what is left of v_com.
  const auto turning = [&](Vec3 spin) {
    return whole_motion(robot, root, {{}, spin}, {state.angle_rad, still}).angular_momentum_kg_m2_s;
  };
  const robot::JointStates joints{state.angle_rad, state.speed_rad_s};
  const Vec3 of_joints = whole_motion(robot, root, {}, joints).angular_momentum_kg_m2_s;
  const Vec3 spin = solve(turning({1.0, 0.0, 0.0}), turning({0.0, 1.0, 0.0}), turning({0.0, 0.0, 1.0}),
                          state.angular_momentum_kg_m2_s - of_joints);
  const robot::WholeMotion about_root = whole_motion(robot, root, {{}, spin}, joints);
  return {.pose = {root, state.angle_rad},
          .velocity_m_s = state.velocity_m_s - about_root.com_velocity_m_s,
          .angular_velocity_rad_s = spin,
          .joint_speed_rad_s = state.speed_rad_s};
}

void set_velocities(const robot::RobotSpec& robot, const MovingPose& motion, RobotState& state) {
  const robot::WholeMotion whole =
      whole_motion(robot, motion.pose.root, {motion.velocity_m_s, motion.angular_velocity_rad_s},
                   {motion.pose.joint_angle_rad, motion.joint_speed_rad_s});
  state.velocity_m_s = whole.com_velocity_m_s;
  state.angular_momentum_kg_m2_s = whole.angular_momentum_kg_m2_s;
  state.speed_rad_s = motion.joint_speed_rad_s;
}

}  // namespace amble::physics::batch

namespace amble::physics {
namespace {

using batch::LockstepState;
using batch::StateRows;

class LockstepEngine final : public BatchEngine {
 public:
  LockstepEngine(const robot::RobotSpec& robot, const EngineSettings& settings)
      : robot_(robot),
        model_(robot),
        rows_(model_),
        workspace_(model_),
        root_com_m_(robot.bodies[0].com_m),
        start_root_{robot.bodies[0].position_m, robot.bodies[0].rotation},
        mass_kg_(robot.total_mass_kg()),
        timestep_s_(static_cast<float>(settings.timestep_s)),
        with_torques_(settings.torques),
        torques_nm_(rows_.links, batch::lanes),
        with_loads_(settings.loads),
        loads_n_(model_.legs, batch::lanes),
        robots_(model_, rows_),
        start_(model_, rows_),
        posed_(model_, rows_) {
    pose_start();
    for (int lane = 0; lane < batch::lanes; ++lane) {
      place(lane);
      retire(lane);
    }
  }

  int lanes() const override { return batch::lanes; }

  void place(int lane) override { copy_into(lane, start_); }

  void place_at(int lane, const StartPose& start) override {
    AMBLE_CHECK(start.joint_angle_rad.size() == model_.links.size(), "an angle per joint");
    pose(posed_, start);
    copy_into(lane, posed_);
  }

  void place_moving(int lane, const MovingPose& motion) override {
    AMBLE_CHECK(motion.pose.joint_angle_rad.size() == model_.links.size(), "an angle per joint");
    pose(posed_, motion.pose, &motion);
    copy_into(lane, posed_);
  }

  MovingPose motion(int lane) const override {
    const RobotState state = robots_.state(lane);
    return batch::motion_of(robot_, root_pose(lane), state);
  }

  void retire(int lane) override {
    check_lane(lane);
    robots_.at(StateRows::active, lane) = 0.0f;
  }

  void step(const LaneArray& targets_rad) override {
    AMBLE_CHECK(targets_rad.rows() == rows_.links && targets_rad.lanes() == batch::lanes, "targets");
    batch::step(arguments_for(robots_), targets_rad);
    if (with_loads_) measure_loads();
  }

  void push(int lane, Vec3 impulse_n_s) override {
    check_lane(lane);
    AMBLE_CHECK(robots_.at(StateRows::active, lane) == 1.0f, "only a placed robot can be pushed");
    robots_.put(StateRows::push_impulse, lane, robots_.vec3(StateRows::push_impulse, lane) + impulse_n_s);
  }

  bool healthy(int lane) const override {
    check_lane(lane);
    return robots_.at(StateRows::healthy, lane) == 1.0f;
  }

  const robot::SensorFrame& sensors() const override { return robots_.sensors(); }
  const LaneArray* motor_torque_nm() const override { return with_torques_ ? &torques_nm_ : nullptr; }
  const LaneArray* foot_load_n() const override { return with_loads_ ? &loads_n_ : nullptr; }

  RootPose root_pose(int lane) const override {
    return {com_m(lane) + robots_.to_world(lane, robots_.vec3(StateRows::torso_origin, lane)),
            robots_.rotation(lane)};
  }
  Vec3 root_com_m(int lane) const override {
    return com_m(lane) + robots_.to_world(lane, robots_.vec3(StateRows::torso_origin, lane) + root_com_m_);
  }
  Vec3 com_m(int lane) const override {
    check_lane(lane);
    return robots_.vec3(StateRows::com, lane) + robots_.vec3(StateRows::com_compensation, lane);
  }
  Vec3 momentum_kg_m_s(int lane) const override {
    check_lane(lane);
    return mass_kg_ * robots_.vec3(StateRows::velocity, lane);
  }

  std::uint64_t state_hash(int lane) const override {
    check_lane(lane);
    std::vector<float> values;
    values.reserve(to_index(StateRows::active + 2 * rows_.links));
    for (int r = 0; r < StateRows::active; ++r) values.push_back(robots_.at(r, lane));
    for (int r = rows_.angle; r < rows_.joint_impulse; ++r) values.push_back(robots_.at(r, lane));
    return hash_span<float>(values);
  }

  void set_state(int lane, const RobotState& state) override {
    check_lane(lane);
    AMBLE_CHECK(robots_.at(StateRows::active, lane) == 1.0f, "a lane is placed before its state is set");
    robots_.set_state(lane, state);
    batch::derive(arguments_for(robots_));
  }
  RobotState state(int lane) const override {
    check_lane(lane);
    return robots_.state(lane);
  }
  int contacts(int lane) const override {
    check_lane(lane);
    return static_cast<int>(robots_.at(StateRows::contacts, lane));
  }

 private:
  static void check_lane(int lane) {
    AMBLE_CHECK(lane >= 0 && lane < batch::lanes, "the batch engine has 16 lanes");
  }

  batch::StepArguments arguments_for(LockstepState& robots) {
    workspace_.attach();
    return {.model = model_,
            .rows = rows_,
            .state = robots.rows(),
            .workspace = workspace_,
            .sensors = robots.sensors(),
            .ground = ground() ? &uneven_ : nullptr,
            .torques_nm = with_torques_ ? &torques_nm_ : nullptr,
            .timestep_s = timestep_s_};
  }

  void on_ground() override {
    uneven_ = {};
    if (const ground::Ground* const all = ground()) {
      for (const ground::HeightField& field : all->fields())
        uneven_.fields.push_back(field.heights_m().data());
      uneven_.cells_per_m = static_cast<float>(1.0 / all->surface().cell_m());
      // What rounding to float32 may hide.
      uneven_.highest_m = static_cast<float>(all->highest_m() + 1e-5);
    }
    pose_start();
  }

  void pose_start() {
    pose(start_, {.root = start_root_, .joint_angle_rad = std::vector<double>(model_.links.size(), 0.0)});
  }

  /// Sets the robot in lane 0 to a pose, at rest or (if `motion` is given, with that pose) moving.
  void pose(LockstepState& robots, const StartPose& start, const MovingPose* motion = nullptr) {
    robots.at(StateRows::active, 0) = robots.at(StateRows::healthy, 0) = 1.0f;
    RobotState state{.com_m = start.root.position_m,
                     .rotation = start.root.rotation,
                     .velocity_m_s = {},
                     .angular_momentum_kg_m2_s = {},
                     .angle_rad = start.joint_angle_rad,
                     .speed_rad_s = std::vector<double>(start.joint_angle_rad.size(), 0.0)};
    robots.set_state(0, state);
    batch::derive(arguments_for(robots));
    // Now the centre of mass is where the origin of the root's frame belongs.
    state.com_m = start.root.position_m - robots.to_world(0, robots.vec3(StateRows::torso_origin, 0));
    if (motion != nullptr) batch::set_velocities(robot_, *motion, state);
    robots.set_state(0, state);
    batch::derive(arguments_for(robots));
  }

  /// The impulses along the normals of a foot's points in the last step, by its length.
  void measure_loads() {
    for (int lane = 0; lane < batch::lanes; ++lane) loads_n_.set_lane(lane, 0.0f);
    const float per_step = 1.0f / timestep_s_;
    for (const batch::PointGroup& geom : model_.geoms) {
      if (geom.leg < 0) continue;
      for (int p = geom.first; p < geom.first + geom.count; ++p)
        for (int lane = 0; lane < batch::lanes; ++lane)
          loads_n_.at(geom.leg, lane) += robots_.at(rows_.point_impulse + 3 * p, lane) * per_step;
    }
  }

  void copy_into(int lane, const LockstepState& resting) {
    check_lane(lane);
    robots_.copy(lane, resting, 0);
    torques_nm_.set_lane(lane, 0.0f);
    loads_n_.set_lane(lane, 0.0f);
  }

  const robot::RobotSpec robot_;
  const batch::Model model_;
  const StateRows rows_;
  batch::Workspace workspace_;
  const Vec3 root_com_m_;
  const RootPose start_root_;
  const double mass_kg_;
  const float timestep_s_;
  const bool with_torques_;
  batch::UnevenGround uneven_;  ///< of ground(), if that is not null
  LaneArray torques_nm_;
  const bool with_loads_;
  LaneArray loads_n_;
  LockstepState robots_;
  LockstepState start_;  ///< lane 0: in the start pose
  LockstepState posed_;  ///< lane 0: in the pose of the last place_at()
};

}  // namespace

std::unique_ptr<BatchEngine> make_batch_engine(const robot::RobotSpec& robot,
                                               const EngineSettings& settings) {
  return std::make_unique<LockstepEngine>(robot, settings);
}

}  // namespace amble::physics

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_batch;
const bool amble_registers_physics_batch = [] {
  amble::physics::register_engine({.name = "batch",
                                   .traits = {.lanes = amble::physics::batch::lanes},
                                   .make = amble::physics::make_batch_engine});
  return true;
}();
