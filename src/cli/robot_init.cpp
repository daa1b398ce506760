#include "amble/cli/robot_init.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/robot_solver.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/io/file.hpp"
#include "amble/io/printable.hpp"
#include "amble/io/shell.hpp"
#include "amble/io/toml_text.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/doubts.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/summary.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

/// Of all presets the one that makes walkers of most robots in a minute (docs/ROBOTS.md).
constexpr const char* preset_name = "configs/quick/supg.toml";

/// The config that the new one extends: in the source tree or the installation that this program is part of,
/// or below the current folder.
std::optional<fs::path> preset() {
  const fs::path name = preset_name;
  std::error_code error;
  std::vector<fs::path> folders;
  for (fs::path at = fs::read_symlink("/proc/self/exe", error).parent_path(); at.has_relative_path();
       at = at.parent_path()) {
    folders.push_back(at);
    folders.push_back(at / "share/amble");
  }
  folders.push_back(fs::current_path());
  for (const fs::path& folder : folders)
    if (fs::exists(folder / name, error)) return folder / name;
  return std::nullopt;
}

/// A path as a file in `folder` names it.
std::string path_from(const fs::path& folder, const fs::path& path) {
  const fs::path relative = fs::relative(fs::absolute(path), fs::absolute(folder));
  return (relative.empty() ? fs::absolute(path) : relative).generic_string();
}

/// The fastest engine that can simulate the robot, as a line of a config.
std::string engine_line(const robot::RobotSpec& robot) {
  try {
    physics::make_engine("batch", robot, {.timestep_s = 0.01});
    return "engine = \"batch\"\n";
  } catch (const UserError& error) {
    return fmt::format("engine = \"ode\"  # not batch, which is faster: {}\n", error.what());
  }
}

/// What a config of a robot on one or two legs has besides: by distance alone the first generations learn to
/// fall far.
constexpr const char* score_of_two_legs =
    "\n"
    "[score]  # in m; on two legs a fall forwards is the first to win by distance alone\n"
    "terms = [{ quantity = \"distance\", weight = 1.0 }, { quantity = \"upright_time\", weight = 1.0 }]\n";

/// The quadruped for which the presets' times and speeds are: the height of its hips over its feet.
constexpr double preset_leg_height_m = 0.88;
constexpr double preset_gravity_m_s2 = 9.8, preset_period_s = 1.0, preset_push_m_s = 0.2,
                 preset_drop_m = 0.01;

/// Times and speeds of walkers of another size, by Froude's rule: times go with the square root of the legs'
/// height over gravity, speeds with that of the legs' height times gravity. Nothing for robots of about the
/// presets' size.
std::string settings_of_size(const robot::RobotSpec& robot) {
  const double height_m = robot::leg_height_m(robot), gravity_m_s2 = norm(robot.gravity_m_s2);
  if (!(height_m > 0.0) || !(gravity_m_s2 > 0.0)) return {};
  const double size = height_m / preset_leg_height_m, pull = gravity_m_s2 / preset_gravity_m_s2;
  const double time = std::sqrt(size / pull);
  constexpr double alike = 0.15;
  if (std::abs(time - 1.0) < alike) return {};
  const double period_s = std::clamp(std::round(100.0 * preset_period_s * time) / 100.0, 0.05, 5.0);
  return fmt::format(
      "\n"
      "[controller.supg]\n"
      "period_s = {:g}  # hips {:.2g} m over the feet; 1 s where they are {:g} m, by the square root "
      "(Froude)\n"
      "\n"
      "[noise]  # what the preset's pushes and drops are for a robot of that size\n"
      "push_m_s = {:.2g}\n"
      "start_height_m = {:.2g}\n",
      period_s, height_m, preset_leg_height_m, preset_push_m_s * std::sqrt(size * pull),
      preset_drop_m * size);
}

std::string config_text(const std::string& name, const std::string& engine,
                        const std::optional<robot::RobotSpec>& robot, const fs::path& folder) {
  const std::size_t legs = robot ? robot->legs.size() : 0;
  const auto base = preset();
  return fmt::format(
      "# {0}: SUPGs under noise. Beside the preset are sine.toml and ctrnn.toml; `amble settings` lists all "
      "that may be set.\n"
      "{1}include = [{2}]\n"
      "name = {3}\n"
      "robot = {4}\n"
      "{5}"
      "\n"
      "[controller]\n"
      "substrate = \"auto\"  # a node for each joint, made from the robot's legs and joint types\n"
      "{6}{7}",
      io::printable(name), base ? "" : "# The presets of amble were not found: correct this path.\n",
      io::toml_quoted(base ? path_from(folder, *base) : preset_name), io::toml_quoted(name),
      io::toml_quoted(name + ".toml"), engine, robot ? settings_of_size(*robot) : "",
      legs == 1 || legs == 2 ? score_of_two_legs : "");
}

}  // namespace

std::string doubts_text(const std::vector<std::string>& doubts) {
  std::string text = doubts.empty() ? "" : "warnings:\n";
  for (const std::string& line : doubts) text += "  " + line + "\n";
  return text;
}

std::string start_text(const robot::RobotSpec& robot) {
  const auto engine = engine_line(robot).starts_with("engine = \"batch\"") ? "batch" : "ode";
  const auto odd = experiment::odd_at_start(robot, engine, physics::EngineSettings{}.timestep_s);
  if (odd.empty() && robot.legs.empty()) return "";
  if (odd.empty()) return "start: held for a second in its start pose, it stands\n";
  return fmt::format("look at its start before you evolve:\n  {}\n", fmt::join(odd, "\n  "));
}

ExitCode init_robot(const fs::path& model, fs::path folder) {
  if (model.extension() == ".toml" || model.extension() == ".json")
    fail(ExitCode::bad_input, "--init: {} is a robot file: expected a model, MJCF (.xml) or URDF (.urdf)",
         model.string());
  if (folder.empty()) folder = model.stem();
  const morphology::ModelFile file = morphology::compile_model(model);
  const morphology::RobotGuess guess = morphology::guess_robot(file, path_from(folder, model));
  const fs::path robot_path = folder / (guess.name + ".toml"), config_path = folder / "evolve.toml";
  if (robot_path.filename() == config_path.filename())
    fail(ExitCode::bad_input, "--init: the model must not be called evolve, as the config is");
  for (const fs::path& path : {robot_path, config_path})
    if (fs::exists(path))
      fail(ExitCode::bad_input, "{} is there already, and is not replaced", path.string());
  fs::create_directories(folder);
  io::write_file(robot_path, guess.toml);

  std::vector<std::string> asked = guess.asked;
  morphology::ReadingNotes notes;
  std::optional<robot::RobotSpec> robot;
  try {
    robot = morphology::load_robot(robot_path, &notes);
    // The file ends with [contact].
    if (const std::string sweeps = sweeps_line(*robot); !sweeps.empty()) {
      io::write_file(robot_path, guess.toml + sweeps);
      robot = morphology::load_robot(robot_path);
    }
  } catch (const UserError& error) {
    asked.emplace_back(error.what());
  }
  const std::string engine = robot ? engine_line(*robot) : "engine = \"batch\"\n";
  io::write_file(config_path, config_text(guess.name, engine, robot, folder));
  if (robot) fmt::print("{}", robot::summary(*robot));
  if (!notes.lines().empty()) fmt::print("\nimport notes:\n{}", notes.text());
  if (robot)
    if (const std::string text = start_text(*robot); !text.empty()) fmt::print("\n{}", text);
  fmt::print("\nwrote {} and {}\n", robot_path.string(), config_path.string());
  if (!asked.empty()) {
    fmt::print("still to be given in {}:\n", robot_path.string());
    for (const std::string& line : asked) fmt::print("  {}\n", line);
  }
  std::vector<std::string> doubts = guess.doubts;
  if (robot)
    for (const std::string& line : robot::doubts(*robot)) doubts.push_back(line);
  fmt::print("{}", doubts_text(doubts));
  const bool ready = robot && !robot->legs.empty();
  if (ready)
    fmt::print("next: read {0}, then\n  amble evolve {1} --out {2}\n", robot_path.string(),
               io::shell_word(config_path.string()), io::shell_word((folder / "run").string()));
  else
    fmt::print("next: complete it, and check it with\n  amble robot {}\n",
               io::shell_word(robot_path.string()));
  return ready ? ExitCode::ok : ExitCode::bad_input;
}

}  // namespace amble::cli
