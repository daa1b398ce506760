#include <pybind11/stl.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/robot_folder.hpp"
#include "amble/robot/json.hpp"
#include "python/bind.hpp"
#include "python/robot_batch.hpp"

namespace amble::python {
namespace {

constexpr int most_robots = 1 << 20, most_threads = 1024;

/// A RobotBatch that threads of Python may share: one call at a time.
struct Robots {
  Robots(RobotBatch::Kind kind, int count, int threads, const std::atomic<bool>& stop)
      : batch(std::move(kind), count, threads, stop) {}

  RobotBatch batch;
  py::object shown;  ///< the view that step() and reset() return
  CallLock lock;

  /// ODE's worlds belong to the threads that step them, which are not in a forked process.
  void check_process() const {
    if (!batch.works_here())
      throw std::runtime_error(
          "Robots do not come along into a forked process: make new ones in each process, or start processes "
          "by multiprocessing.get_context(\"spawn\")");
  }
};

/// A bare name ("hexapod", "quadruped/paper") is that of one of amble's own robots, unless there is such a
/// file.
std::filesystem::path robot_file(const std::filesystem::path& name) {
  if (name.has_extension() || std::filesystem::is_regular_file(name)) return name;
  const py::dict own = py::module_::import("amble._data").attr("robots")();
  std::string names;
  for (const auto& [each, file] : own) {
    if (each.cast<std::string>() == name.string()) return path_of(py::reinterpret_borrow<py::object>(file));
    names += (names.empty() ? "" : ", ") + each.cast<std::string>();
  }
  fail(ExitCode::bad_input, "no robot '{}': expected the path of a robot file, or one of {}", name.string(),
       names);
}

/// The robot of a Config, damaged, raised by its drop_m and with its ground's slope and friction, but without
/// its height field.
RobotBatch::Kind kind_of(const LoadedConfig& config, const std::string& engine) {
  auto problem = experiment::Problem::make(config.value, *config.robot);
  return {.robot = std::move(problem.robot),
          .damage = std::move(problem.damage),
          .engine = engine,
          .settings = {.timestep_s = problem.trial.timestep_s,
                       .ground_friction = problem.ground.friction,
                       .own = std::move(problem.engine_own)}};
}

/// What makes the kind of a Config, or of a robot file; to be called without the interpreter's lock.
std::function<RobotBatch::Kind()> maker_of(const py::object& robot, const std::string& engine) {
  if (py::isinstance<LoadedConfig>(robot))
    return [config = robot.cast<const LoadedConfig&>(), engine] { return kind_of(config, engine); };
  return [file = robot_file(written_path_of(robot)), engine] {
    return RobotBatch::Kind{
        .robot = experiment::load_robot_file(file), .damage = {}, .engine = engine, .settings = {}};
  };
}

std::unique_ptr<Robots> make(const py::object& robot, int n, const std::string& engine,
                             std::optional<double> timestep_s, std::optional<int> threads, bool forces) {
  check_whole("n", n, 1, most_robots);
  if (threads) check_whole("threads", *threads, 1, most_threads);
  if (timestep_s && !(*timestep_s >= 1e-5 && *timestep_s <= 0.1))
    throw py::value_error(fmt::format("timestep_s: {}: expected a number from 1e-05 to 0.1", *timestep_s));
  physics::check_engine_name(engine, "engine: ");
  const auto make_kind = maker_of(robot, engine);
  // More threads than groups of lanes would only wait.
  const int lanes = physics::engine_traits(engine).lanes;
  const int useful = std::min(jobs_of(threads), (n + lanes - 1) / lanes);
  std::unique_ptr<Robots> robots;
  Interruptible interruptible;
  interruptible.run([&] {
    auto kind = make_kind();
    kind.settings.timestep_s = timestep_s.value_or(kind.settings.timestep_s);
    kind.settings.torques = kind.settings.loads = forces;
    robots = std::make_unique<Robots>(std::move(kind), n, useful, interruptible.stop());
  });
  return robots;
}

py::array columns(const Robots& self, int first, int count) {
  const auto& all = self.batch.observations();
  constexpr auto size = static_cast<py::ssize_t>(sizeof(float));
  return live_view(all, all->values.data() + first, {all->robots, count}, {all->width * size, size},
                   "float32");
}

py::array flags(const Robots& self, std::vector<std::uint8_t> Observations::*member) {
  const auto& all = self.batch.observations();
  return live_view(all, (all.get()->*member).data(), {all->robots}, {1}, "bool");
}

/// [n, count] of what is there with forces=True alone.
py::array forces(const Robots& self, std::vector<float> Observations::*member, int count) {
  const auto& all = self.batch.observations();
  const std::vector<float>& values = (*all).*member;
  if (values.empty()) throw py::value_error("made without forces: Robots(…, forces=True) measures them");
  constexpr auto size = static_cast<py::ssize_t>(sizeof(float));
  return live_view(all, values.data(), {all->robots, count}, {count * size, size}, "float32");
}

py::object observations(Robots& self) {
  if (!self.shown) self.shown = columns(self, 0, self.batch.observations()->width);
  return self.shown;
}

py::object step(Robots& self, const py::object& targets) {
  self.check_process();
  const auto& all = self.batch.observations();
  const auto values = numbers_of<float>(targets, "targets", {all->robots, all->joints});
  const std::span<const float> span(values.data(), to_index(values.size()));
  bool stepped = false;
  {
    const Unlocked unlocked;
    const auto lock = self.lock.hold();
    stepped = self.batch.step(span);
  }
  if (!stepped) throw py::value_error("targets: expected numbers, found NaN");
  return observations(self);
}

py::object reset(Robots& self, const py::object& mask) {
  self.check_process();
  const auto chosen = mask_of(mask, self.batch.count());
  {
    const Unlocked unlocked;
    const auto lock = self.lock.hold();
    self.batch.reset(chosen);
  }
  return observations(self);
}

py::array state_hashes(Robots& self) {
  self.check_process();
  std::vector<std::uint64_t> hashes;
  {
    const Unlocked unlocked;
    const auto lock = self.lock.hold();
    hashes = self.batch.state_hashes();
  }
  return py::array_t<std::uint64_t>(static_cast<py::ssize_t>(hashes.size()), hashes.data());
}

py::array ranges(const Robots& self, double robot::AngleRange::*bound) {
  const auto& joints = self.batch.robot().joints;
  py::array_t<float> values(static_cast<py::ssize_t>(joints.size()));
  std::ranges::transform(joints, values.mutable_data(), [&](const robot::Joint& joint) {
    return static_cast<float>(joint.command_range().*bound);
  });
  return values;
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

void bind_views(py::class_<Robots>& type) {
  type.def_property_readonly(
          "observations", observations,
          R"(All of the arrays below side by side: [n, joints + legs + 6], float32, a live read-only view.)")
      .def_property_readonly(
          "angle_rad", [](const Robots& self) { return columns(self, 0, self.batch.observations()->joints); },
          "Joint angles, rad, from the start pose: [n, joints], a live view.")
      .def_property_readonly(
          "touch",
          [](const Robots& self) {
            const auto& all = *self.batch.observations();
            return columns(self, all.touch_column(), all.legs);
          },
          "1 while a foot touches the ground, else 0: [n, legs], a live view.")
      .def_property_readonly(
          "attitude_rad",
          [](const Robots& self) { return columns(self, self.batch.observations()->attitude_column(), 3); },
          "Roll, pitch and yaw of the root, rad: [n, 3], a live view.")
      .def_property_readonly(
          "com_m",
          [](const Robots& self) { return columns(self, self.batch.observations()->com_column(), 3); },
          "Centre of mass of the whole robot in the world, m: [n, 3], a live view.")
      .def_property_readonly(
          "torque_nm",
          [](const Robots& self) {
            return forces(self, &Observations::torque_nm, self.batch.observations()->joints);
          },
          R"(Torque of each joint's motor in the last step, N m: [n, joints], a live view. ValueError without forces.)")
      .def_property_readonly(
          "load_n",
          [](const Robots& self) {
            return forces(self, &Observations::load_n, self.batch.observations()->legs);
          },
          R"(Force of the ground against each foot in the last step, along its normal, N: [n, legs], a live view.
ValueError without forces.)")
      .def_property_readonly(
          "fallen", [](const Robots& self) { return flags(self, &Observations::fallen); },
          "Whether the root is lower than where trials end as fallen: [n], bool, a live view.")
      .def_property_readonly(
          "diverged", [](const Robots& self) { return flags(self, &Observations::diverged); },
          R"(Whether the simulation has left the finite: [n], bool, a live view.
Such a robot keeps its last observations until reset().)");
}

py::list texts_of(const std::vector<std::string>& lines) {
  py::list texts;
  for (const std::string& line : lines) texts.append(text_of(line));
  return texts;
}

/// As `amble robot --init`; the config extends the preset that came with the module.
py::dict new_robot(const py::object& model, const py::object& out) {
  const auto model_file = written_path_of(model);
  if (model_file.empty()) throw py::value_error("model: expected the path of a model, MJCF or URDF");
  const auto folder = out.is_none() ? std::filesystem::path() : written_path_of(out);
  const auto preset =
      path_of(py::module_::import("amble._data").attr("data_folder")()) / experiment::robot_preset;
  const auto here = std::filesystem::current_path();
  std::optional<experiment::RobotFolder> written;
  Interruptible interruptible;
  interruptible.run([&] {
    written = experiment::write_robot_folder(
        model_file, folder, std::filesystem::exists(preset) ? std::optional(preset) : std::nullopt,
        interruptible.stop());
  });
  py::dict dict;
  dict["robot"] = path_text(here / written->robot_file);
  dict["config"] = path_text(here / written->config_file);
  if (!written->steer_file.empty()) dict["steer_config"] = path_text(here / written->steer_file);
  dict["ready"] = written->ready;
  dict["missing"] = texts_of(written->asked);
  dict["settled"] = texts_of(written->settled);
  dict["warnings"] = texts_of(written->warnings);
  dict["text"] = text_of(written->text);
  return dict;
}

}  // namespace

void bind_robots(py::module_& module) {
  py::class_<Robots> type(module, "Robots",
                          R"(n copies of a robot that advance together, for learning and control from Python.

Arrays are live: step() and reset() write into them, and they stay valid without the Robots. Joints and legs are in
control order (docs/CONVENTIONS.md). Several threads may use one object; their calls come one after the other.)");
  type.def(
          py::init(&make), py::arg("robot"), py::arg("n") = 1, py::arg("engine") = "batch", py::kw_only(),
          py::arg("timestep_s") = py::none(), py::arg("threads") = py::none(), py::arg("forces") = false,
          R"(robot: name of one of robots(), path of a robot file (TOML or robot.json), or a Config, of which damage and the ground's
slope and friction count, as robots are on a plane. n: 1 to 1,048,576. engine: "batch" (sixteen at a time), "ode", "ode-variant", "mujoco" or "mujoco-model".
timestep_s: s (default: the config's, else 0.01). threads: default processors; results do not depend on it. forces:
measure torque_nm and load_n, too, which changes nothing else. All robots stand in their start pose. Raises Error.)")
      .def(
          "step", step, py::arg("targets"),
          R"(Advances each robot by one timestep towards its target angles; returns observations, the live view.

targets: [n, joints], rad, real numbers, not NaN; clamped to the joints' stops. float32 in C order is used without a
copy. The interpreter's lock is released. Raises TypeError and ValueError.)")
      .def("reset", reset, py::arg("mask") = py::none(),
           R"(Puts robots into the start pose, at rest; returns observations, the live view.

mask: [n], bool: which ones (default: all).)")
      .def("state_hashes", state_hashes,
           "A hash of each robot's positions and velocities, to the bit: [n], uint64.")
      .def("__len__", [](const Robots& self) { return self.batch.count(); })
      .def_property_readonly("threads", [](const Robots& self) { return self.batch.threads(); })
      .def_property_readonly("timestep_s", [](const Robots& self) { return self.batch.timestep_s(); })
      .def_property_readonly(
          "joints", [](const Robots& self) { return names_of(self.batch.robot().joints); },
          "Names, in control order.")
      .def_property_readonly(
          "legs", [](const Robots& self) { return names_of(self.batch.robot().legs); }, "Names, in order.")
      .def_property_readonly(
          "lower_rad", [](const Robots& self) { return ranges(self, &robot::AngleRange::lower_rad); },
          "Least targets that controllers give, rad: [joints].")
      .def_property_readonly(
          "upper_rad", [](const Robots& self) { return ranges(self, &robot::AngleRange::upper_rad); },
          "Greatest targets that controllers give, rad: [joints].");
  bind_views(type);
  refuse_unmade<Robots>();

  module.def(
      "new_robot", new_robot, py::arg("model"), py::arg("out") = py::none(),
      R"(Guesses a robot file from a model, MJCF (.xml) or URDF (.urdf), and writes it and a config into a folder.

out: the folder (default: one of the model's name). Returns a dict: robot and config, absolute paths of the two files; ready,
whether the config can be evolved at once; missing, what is still to be given in the robot file, settled, what was
guessed and why, warnings, a str each; text, all of it as `amble robot --init` prints it. Nothing is replaced. Raises Error.)");
}

}  // namespace amble::python
