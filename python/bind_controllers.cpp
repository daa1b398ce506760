#include <pybind11/stl.h>

#include <cmath>

#include "amble/core/index.hpp"
#include "amble/robot/sensors.hpp"
#include "python/bind.hpp"
#include "python/task.hpp"

namespace amble::python {
namespace {

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
        shown(std::make_shared<std::vector<float>>(to_index(count) * to_index(joints))) {
    for (const neat::Genome& genome : genomes) parameters.push_back(task->problem().decode(genome));
    reset({});
  }

  /// Those whose mask is not 0, or all if it is empty.
  void reset(std::span<const std::uint8_t> mask) {
    for (int lane = 0; lane < count; ++lane)
      if (mask.empty() || mask[to_index(lane)] != 0) batch->load(lane, *parameters[to_index(lane)]);
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
  CallLock lock;
};

std::unique_ptr<Controllers> make_controllers(const py::object& problem, const py::object& genomes) {
  auto task = task_of(problem);
  const auto all = checked_genomes(*task, genomes);
  if (all.empty()) throw py::value_error("genomes: expected at least one");
  const py::gil_scoped_release release;
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

py::array step_controllers(Controllers& self, const py::object& angle_rad, const py::object& touch,
                           const py::object& attitude_rad) {
  const auto angles = finite_rows(angle_rad, "angle_rad", self.count, self.joints),
             touches = finite_rows(touch, "touch", self.count, self.legs);
  std::optional<Rows> attitudes;
  if (!attitude_rad.is_none()) attitudes = finite_rows(attitude_rad, "attitude_rad", self.count, 3);
  {
    const py::gil_scoped_release release;
    const auto lock = self.lock.hold();
    to_lanes(angles, self.sensors.joint_angle_rad);
    to_lanes(touches, self.sensors.touch);
    if (attitudes)
      to_lanes(*attitudes, self.sensors.attitude_rad);
    else
      self.sensors.attitude_rad = LaneArray(3, self.count);
    self.tick();
  }
  return live_view(self.shown, self.shown->data(), {self.count, self.joints},
                   {self.joints * static_cast<py::ssize_t>(sizeof(float)), sizeof(float)}, "float32");
}

void reset_controllers(Controllers& self, const py::object& mask) {
  const auto chosen = mask_of(mask, self.count);
  const py::gil_scoped_release release;
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
          py::arg("attitude_rad") = py::none(),
          R"(One tick (Config: trial.timestep_s): sensors in, target angles out: [n, joints], rad, a live read-only view.

angle_rad: [n, joints], from the start pose. touch: [n, legs], 1 on the ground, else 0. attitude_rad: [n, 3], roll, pitch
and yaw of the root (default: 0). All finite. The interpreter's lock is released. Raises TypeError and ValueError.)")
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
