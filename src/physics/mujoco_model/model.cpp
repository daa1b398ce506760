#include "amble/physics/mujoco_model/model.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::physics::mujoco_model {
namespace {

/// Compiling takes long where there are meshes, and a run makes many engines for one robot: the last model is
/// kept as long as somebody has it.
std::shared_ptr<const mjModel> compiled(const std::shared_ptr<const robot::OriginalModel>& original) {
  static std::mutex mutex;
  static std::weak_ptr<const robot::OriginalModel> last_original;
  static std::shared_ptr<const mjModel> last;
  const std::lock_guard lock(mutex);
  if (last_original.lock() != original || !last) {
    last = morphology::compile_mjcf(original->mjcf, "the engine mujoco-model", original->meshes);
    last_original = original;
  }
  return last;
}

void refuse_misfit(const robot::RobotSpec& robot) {
  fail(ExitCode::bad_input,
       "the engine mujoco-model: the model that robot '{}' carries is not that of its parts",
       io::printable(robot.name));
}

void find_parts(const robot::RobotSpec& robot, Model& model) {
  const robot::OriginalModel& original = *robot.original;
  const mjModel& m = *model.mujoco;
  if (original.joints.empty() || original.start.size() != to_index(m.nq)) refuse_misfit(robot);
  for (const int joint : original.joints) {
    if (joint >= m.njnt || m.jnt_type[joint] != mjJNT_HINGE) refuse_misfit(robot);
    model.position_of.push_back(m.jnt_qposadr[joint]);
    model.dof_of.push_back(m.jnt_dofadr[joint]);
  }
  const int root = m.body_rootid[m.jnt_bodyid[original.joints[0]]];
  if (!morphology::moves_as_root(m, root)) refuse_misfit(robot);
  model.root = Root(m, root);
  model.leg_of.assign(to_index(m.ngeom), -1);
  for (int leg = 0; leg < static_cast<int>(robot.legs.size()); ++leg)
    for (const int geom : robot.legs[to_index(leg)].foot_geoms) {
      const int number = original.geoms[to_index(geom)];
      if (number >= m.ngeom) refuse_misfit(robot);
      model.leg_of[to_index(number)] = leg;
    }
  for (int g = 0; g < m.ngeom; ++g)
    if (morphology::is_ground(m, g)) model.grounds.push_back(g);
}

/// Puts the root of the start pose where the robot has it.
void place_root(const robot::RobotSpec& robot, Model& model) {
  const robot::Body& wanted = robot.bodies[0];
  if (model.root.is_free()) {
    const Vec3 p = wanted.position_m;
    const Quat q = wanted.rotation;
    const mjtNum pose[] = {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
    std::ranges::copy(pose, model.start.begin() + model.root.position());
    return;
  }
  const morphology::MujocoData data = morphology::new_mujoco_data(model.get(), "the engine mujoco-model");
  std::ranges::copy(model.start, data->qpos);
  mj_kinematics(model.get(), data.get());
  const auto apart = [&] {
    const RootPose is = model.root.pose(*data);
    const Quat turn = is.rotation * conjugate(wanted.rotation);
    return std::max(norm(is.position_m - wanted.position_m), norm(Vec3{turn.x, turn.y, turn.z}));
  };
  constexpr double rounding = 1e-9;
  if (apart() <= rounding) return;  // the model's own numbers stay as they are
  model.root.place(model.get(), {wanted.position_m, wanted.rotation}, data.get());
  if (apart() > rounding)
    fail(ExitCode::bad_input,
         "the engine mujoco-model: robot '{}': its root is not free, and the joints on which it moves do not "
         "let it start at ({:.4g}, {:.4g}, {:.4g}) m turned as it is: expected start_height_m, drop_m and "
         "start_rpy_deg to leave it where they can take it",
         io::printable(robot.name), wanted.position_m.x, wanted.position_m.y, wanted.position_m.z);
  std::copy(data->qpos, data->qpos + model->nq, model.start.begin());
}

constexpr int least_stack_numbers = 1'000'000;

/// With a pyramid of friction, MuJoCo's default, much more makes feet slide.
constexpr double most_friction = 3.0;

void set_friction(mjModel& m, double friction) {
  const double coefficient = std::min(friction, most_friction);
  for (int g = 0; g < m.ngeom; ++g) m.geom_friction[3 * g] = coefficient;
  for (int p = 0; p < m.npair; ++p) m.pair_friction[5 * p] = m.pair_friction[5 * p + 1] = coefficient;
}

void set_steps(double tick_s, Model& model) {
  double& timestep_s = model.mujoco->opt.timestep;
  model.own_timestep_s = timestep_s;
  const double exact = tick_s / timestep_s, whole = std::round(exact);
  constexpr double rounding = 1e-9;
  if (whole >= 1.0 && std::abs(exact - whole) <= rounding * whole) {
    model.steps = static_cast<int>(whole);
    return;
  }
  model.steps = static_cast<int>(std::ceil(exact));
  timestep_s = tick_s / model.steps;
}

}  // namespace

Model make_model(const robot::RobotSpec& robot, const EngineSettings& settings) {
  if (!robot.original)
    fail(ExitCode::bad_input,
         "the engine mujoco-model: robot '{}' does not carry the MJCF it was made from; that takes an MJCF "
         "model (no URDF), keep_model = true in the robot file, and a run begun with it",
         io::printable(robot.name));
  Model model{.mujoco = morphology::ModelPointer(mj_copyModel(nullptr, compiled(robot.original).get())),
              .start = robot.original->start,
              .position_of = {},
              .dof_of = {},
              .leg_of = {},
              .grounds = {}};
  find_parts(robot, model);
  place_root(robot, model);
  mjModel& m = *model.mujoco;
  m.opt.gravity[0] = robot.gravity_m_s2.x;
  m.opt.gravity[1] = robot.gravity_m_s2.y;
  m.opt.gravity[2] = robot.gravity_m_s2.z;
  if (settings.ground_friction >= 0.0) set_friction(m, settings.ground_friction);
  // Too small a stack ends the process, and its size changes no motion.
  m.nstack = std::max(m.nstack, least_stack_numbers);
  set_steps(settings.timestep_s, model);
  return model;
}

}  // namespace amble::physics::mujoco_model
