#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/robot/sensors.hpp"
#include "amble/trial/senses.hpp"
#include "python/bind.hpp"
#include "python/task.hpp"

namespace amble::python {
namespace {

/// As engines sense it.
float yaw_of_start(const robot::RobotSpec& robot) {
  const Quat level = robot::horizontal_frame(robot.gravity_m_s2);
  return static_cast<float>(roll_pitch_yaw(conjugate(level)).yaw_rad);
}

/// A controller per genome, one after the other in the lanes of one batch.
struct Controllers {
  Controllers(std::shared_ptr<Task> of, std::span<const neat::Genome> genomes)
      : task(std::move(of)),
        count(static_cast<int>(genomes.size())),
        joints(static_cast<int>(task->problem().robot.joints.size())),
        legs(static_cast<int>(task->problem().robot.legs.size())),
        batch(task->problem().architecture->make_batch(count)),
        sensors{LaneArray(joints, count), LaneArray(legs, count), LaneArray(3, count)},
        targets_rad(joints, count),
        shown(std::make_shared<std::vector<float>>(to_index(count) * to_index(joints))),
        extra(task->problem().architecture->extra_senses()),
        rate_hz(static_cast<float>(1.0 / task->problem().trial.timestep_s)),
        start_yaw_rad(yaw_of_start(task->problem().robot)),
        headings(to_index(count),
                 trial::ToldHeading(static_cast<float>(task->problem().controller.sensing.heading.lead_rad))),
        begun(to_index(count)) {
    sensors.joint_speed_rad_s = LaneArray(joints, count);
    sensors.yaw_rate_rad_s = LaneArray(1, count);
    sensors.joint_torque_nm = LaneArray(joints, count);
    sensors.foot_load_n = LaneArray(legs, count);
    sensors.command = LaneArray(2, count);
    sensors.command_stop = LaneArray(1, count);
    sensors.heading_error_rad = LaneArray(1, count);
    for (const neat::Genome& genome : genomes) parameters.push_back(task->problem().decode(genome));
    reset({});
  }

  /// Those whose mask is not 0, or all if it is empty.
  void reset(std::span<const std::uint8_t> mask) {
    for (int lane = 0; lane < count; ++lane)
      if (mask.empty() || mask[to_index(lane)] != 0) {
        batch->load(lane, *parameters[to_index(lane)]);
        begun[to_index(lane)] = false;
      }
  }
  /// Roll, pitch or yaw, or what is taken from them.
  bool senses_attitude() const {
    using Kind = substrate::Sensor::Kind;
    return extra.heading_error ||
           std::ranges::any_of(
               std::array{Kind::roll, Kind::pitch, Kind::yaw, Kind::yaw_rate},
               [this](Kind kind) { return task->problem().architecture->reads({.kind = kind}); });
  }
  /// Rates from this tick's angles, which are in `sensors`, and those of the last. In a lane's first tick
  /// from the start pose, where a trial makes a step before it, and 0 where it does not.
  void take_rates(const LaneArray& angles_before_rad, const LaneArray& attitudes_before_rad) {
    const bool stepped = task->problem().trial.first_command == trial::FirstCommand::after_first_step;
    for (int lane = 0; lane < count; ++lane) {
      const bool known = begun[to_index(lane)];
      begun[to_index(lane)] = true;
      for (int joint = 0; joint < joints; ++joint) {
        const float now_rad = sensors.joint_angle_rad.at(joint, lane);
        const float before_rad = known     ? angles_before_rad.at(joint, lane)
                                 : stepped ? 0.0f  // the start pose's
                                           : now_rad;
        sensors.joint_speed_rad_s.at(joint, lane) = trial::rate_of(before_rad, now_rad, rate_hz);
      }
      const float yaw_rad = sensors.attitude_rad.at(2, lane);
      const float before_rad = known ? attitudes_before_rad.at(2, lane) : stepped ? start_yaw_rad : yaw_rad;
      sensors.yaw_rate_rad_s.at(0, lane) = trial::turning_rate_of(before_rad, yaw_rad, rate_hz);
    }
  }
  /// By the commands that the frame has: none is a stop.
  void take_stops() {
    for (int lane = 0; lane < count; ++lane)
      sensors.command_stop.at(0, lane) =
          sensors.command.at(0, lane) == 0.0f && sensors.command.at(1, lane) == 0.0f ? 1.0f : 0.0f;
  }
  /// How far the heading that the commanded turns lead to is to the left, from a lane's first tick on. Before
  /// take_rates().
  void take_headings() {
    const auto timestep_s = static_cast<float>(task->problem().trial.timestep_s);
    for (int lane = 0; lane < count; ++lane) {
      const float yaw_rad = sensors.attitude_rad.at(2, lane);
      if (!begun[to_index(lane)]) headings[to_index(lane)].face(yaw_rad);
      const float turned_rad = sensors.command.at(1, lane) * timestep_s;
      sensors.heading_error_rad.at(0, lane) = headings[to_index(lane)].error_rad(yaw_rad, turned_rad);
    }
  }
  void tick() {
    batch->step(sensors, targets_rad);
    for (int lane = 0; lane < count; ++lane)
      for (int joint = 0; joint < joints; ++joint)
        (*shown)[to_index(lane * joints + joint)] = targets_rad.at(joint, lane);
  }

  std::shared_ptr<Task> task;
  int count, joints, legs;
  std::vector<std::unique_ptr<controllers::Parameters>> parameters;
  std::unique_ptr<controllers::Batch> batch;
  robot::SensorFrame sensors;
  LaneArray targets_rad;
  std::shared_ptr<std::vector<float>> shown;  ///< count × joints; views keep it
  robot::ExtraSenses extra;
  float rate_hz, start_yaw_rad;
  std::vector<trial::ToldHeading> headings;
  std::vector<bool> begun;  ///< by lane: whether there was a tick
  CallLock lock;
};

std::unique_ptr<Controllers> make_controllers(const py::object& problem, const py::object& genomes) {
  auto task = task_of(problem);
  const auto all = checked_genomes(*task, genomes);
  if (all.empty()) throw py::value_error("genomes: expected at least one");
  const Unlocked unlocked;
  return std::make_unique<Controllers>(std::move(task), all);
}

using Rows = py::array_t<float, py::array::c_style>;

Rows finite_rows(const py::object& object, const std::string& what, int count, int width) {
  auto rows = numbers_of<float>(object, what, {count, width});
  const float* const values = rows.data();
  for (py::ssize_t i = 0; i < rows.size(); ++i)
    if (!std::isfinite(values[i])) throw py::value_error(what + ": expected finite numbers");
  return rows;
}

void to_lanes(const Rows& from, LaneArray& to) {
  const float* value = from.data();
  for (int lane = 0; lane < to.lanes(); ++lane)
    for (int row = 0; row < to.rows(); ++row) to.at(row, lane) = *value++;
}

/// Readings that are needed only by controllers that sense them.
std::optional<Rows> rows_if_sensed(const py::object& object, const std::string& what, bool sensed, int count,
                                   int width) {
  if (!object.is_none()) return finite_rows(object, what, count, width);
  if (sensed) throw py::value_error(what + " is missing: these controllers sense it");
  return std::nullopt;
}

py::array step_controllers(Controllers& self, const py::object& angle_rad, const py::object& touch,
                           const py::object& attitude_rad, const py::object& torque_nm,
                           const py::object& load_n, const py::object& command) {
  const auto angles = finite_rows(angle_rad, "angle_rad", self.count, self.joints),
             touches = finite_rows(touch, "touch", self.count, self.legs);
  const auto attitudes = rows_if_sensed(attitude_rad, "attitude_rad", self.senses_attitude(), self.count, 3);
  const auto torques = rows_if_sensed(torque_nm, "torque_nm", self.extra.torque, self.count, self.joints),
             loads = rows_if_sensed(load_n, "load_n", self.extra.load, self.count, self.legs),
             commands = rows_if_sensed(command, "command", self.extra.commands(), self.count, 2);
  {
    const Unlocked unlocked;
    const auto lock = self.lock.hold();
    const LaneArray angles_before_rad = self.sensors.joint_angle_rad,
                    attitudes_before_rad = self.sensors.attitude_rad;
    to_lanes(angles, self.sensors.joint_angle_rad);
    to_lanes(touches, self.sensors.touch);
    if (attitudes)
      to_lanes(*attitudes, self.sensors.attitude_rad);
    else
      self.sensors.attitude_rad = LaneArray(3, self.count);
    if (torques) to_lanes(*torques, self.sensors.joint_torque_nm);
    if (loads) to_lanes(*loads, self.sensors.foot_load_n);
    if (commands) to_lanes(*commands, self.sensors.command);
    self.take_stops();
    self.take_headings();
    self.take_rates(angles_before_rad, attitudes_before_rad);
    self.tick();
  }
  return live_view(self.shown, self.shown->data(), {self.count, self.joints},
                   {self.joints * static_cast<py::ssize_t>(sizeof(float)), sizeof(float)}, "float32");
}

void reset_controllers(Controllers& self, const py::object& mask) {
  const auto chosen = mask_of(mask, self.count);
  const Unlocked unlocked;
  const auto lock = self.lock.hold();
  self.reset(chosen);
}

py::array states_of(Controllers& self) {
  const auto names = static_cast<py::ssize_t>(self.batch->state_names().size());
  py::array_t<float> states({static_cast<py::ssize_t>(self.count), names});
  const auto lock = self.lock.hold();
  for (int lane = 0; lane < self.count; ++lane)
    self.batch->state(lane, {states.mutable_data() + lane * names, to_index(names)});
  return states;
}

}  // namespace

void bind_controllers(py::module_& module) {
  py::class_<Controllers>(module, "Controllers",
                          R"(The controllers that genomes describe, one each, for a simulator of one's own.

Joints and legs are in control order (docs/CONVENTIONS.md), as in Robots.)")
      .def(py::init(&make_controllers), py::arg("problem"), py::arg("genomes"),
           "problem: Problem, Search, Config or path. genomes: at least one; they must fit it. Raises Error.")
      .def(
          "step", step_controllers, py::arg("angle_rad"), py::arg("touch"),
          py::arg("attitude_rad") = py::none(), py::arg("torque_nm") = py::none(),
          py::arg("load_n") = py::none(), py::arg("command") = py::none(),
          R"(One tick (Config: trial.timestep_s): sensors in, target angles out: [n, joints], rad, a live read-only view.

angle_rad: [n, joints], from the start pose. touch: [n, legs], 1 on the ground, else 0. attitude_rad: [n, 3], roll, pitch
and yaw of the root, torque_nm: [n, joints], load_n: [n, legs], command: [n, 2], speed (m/s) and turn to the left
(rad/s), of controllers that sense them (docs/CONTROLLERS.md); speeds, the yaw rate and the heading error are taken from tick to tick, in the
first from the start pose where trial.first_command is "after_first_step". All finite. The interpreter's lock is released. Raises TypeError and ValueError.)")
      .def("reset", reset_controllers, py::arg("mask") = py::none(),
           "Puts controllers into their initial state. mask: [n], bool: which ones (default: all).")
      .def_property_readonly(
          "state_names", [](const Controllers& self) { return self.batch->state_names(); },
          "Names of the columns of states: for SUPGs the timers (ticks) and triggers of the legs.")
      .def_property_readonly("states", states_of, "States after the last tick: [n, names], float32, a copy.")
      .def("__len__", [](const Controllers& self) { return self.count; });
  refuse_unmade<Controllers>();
}

}  // namespace amble::python
