#include "amble/cli/robot_init.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <vector>

#include "amble/cli/robot_solver.hpp"
#include "amble/experiment/new_robot.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/io/file.hpp"
#include "amble/io/printable.hpp"
#include "amble/io/shell.hpp"
#include "amble/io/toml_text.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/doubts.hpp"
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

std::string engine_line(const robot::RobotSpec& robot) {
  const experiment::EngineChoice choice = experiment::fastest_engine(robot);
  if (choice.engine == "batch") return "engine = \"batch\"\n";
  return fmt::format("engine = \"{}\"  # not batch, which is faster: {}\n", choice.engine,
                     choice.why_not_batch);
}

/// What a config of a robot on one or two legs has besides: by distance alone the first generations learn to
/// fall far.
constexpr const char* score_of_two_legs =
    "\n"
    "[score]  # in m; on two legs a fall forwards is the first to win by distance alone\n"
    "terms = [{ quantity = \"distance\", weight = 1.0 }, { quantity = \"upright_time\", weight = 1.0 }]\n";

std::string settings_text(const robot::RobotSpec& robot) {
  const auto settings = experiment::settings_of_size(robot);
  if (!settings) return {};
  return fmt::format(
      "\n"
      "[controller.supg]\n"
      "period_s = {:g}  # hips {:.2g} m over the feet; 1 s where they are {:g} m, by the square root "
      "(Froude)\n"
      "\n"
      "[noise]  # what the preset's pushes and drops are for a robot of that size\n"
      "push_m_s = {:.2g}\n"
      "start_height_m = {:.2g}\n",
      settings->period_s, settings->leg_height_m, settings->preset_leg_height_m, settings->push_m_s,
      settings->start_height_m);
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
      io::toml_quoted(name + ".toml"), engine, robot ? settings_text(*robot) : "",
      legs == 1 || legs == 2 ? score_of_two_legs : "");
}

}  // namespace

std::string doubts_text(const std::vector<std::string>& doubts) {
  std::string text = doubts.empty() ? "" : "warnings:\n";
  for (const std::string& line : doubts) text += "  " + line + "\n";
  return text;
}

namespace {

/// How the robot starts in its own model, and what of it the engine mujoco-model does otherwise.
std::string original_model_text(const robot::RobotSpec& robot, const std::vector<std::string>& odd_anyway) {
  constexpr const char* engine = "mujoco-model";
  const double timestep_s = physics::EngineSettings{}.timestep_s;
  try {
    std::vector<std::string> lines = physics::original_model_notes(robot, timestep_s);
    bool odd = false;
    for (std::string& line : experiment::odd_at_start(robot, engine, timestep_s)) {
      if (std::ranges::count(odd_anyway, line) > 0) continue;
      lines.push_back(std::move(line));
      odd = true;
    }
    if (!odd && !robot.legs.empty()) lines.emplace_back("held for a second in its start pose, it stands");
    return fmt::format("in its own model, engine {}:\n  {}\n", engine, fmt::join(lines, "\n  "));
  } catch (const UserError& error) {
    return fmt::format("{}\n", error.what());
  }
}

}  // namespace

std::string start_text(const robot::RobotSpec& robot) {
  const auto odd = experiment::odd_at_start(robot, experiment::fastest_engine(robot).engine,
                                            physics::EngineSettings{}.timestep_s);
  std::string text;
  if (!odd.empty())
    text = fmt::format("look at its start before you evolve:\n  {}\n", fmt::join(odd, "\n  "));
  else if (!robot.legs.empty())
    text = "start: held for a second in its start pose, it stands\n";
  if (robot.original) text += original_model_text(robot, odd);
  return text;
}

ExitCode init_robot(const fs::path& model, fs::path folder) {
  if (model.extension() == ".toml" || model.extension() == ".json")
    fail(ExitCode::bad_input, "--init: {} is a robot file: expected a model, MJCF (.xml) or URDF (.urdf)",
         model.string());
  if (folder.empty()) folder = model.stem();
  const morphology::ModelFile file = morphology::compile_model(model);
  const fs::path robot_path = folder / (model.stem().string() + ".toml"),
                 config_path = folder / "evolve.toml";
  if (robot_path.filename() == config_path.filename())
    fail(ExitCode::bad_input, "--init: the model must not be called evolve, as the config is");
  for (const fs::path& path : {robot_path, config_path})
    if (fs::exists(path))
      fail(ExitCode::bad_input, "{} is there already, and is not replaced", path.string());
  experiment::NewRobot made = experiment::make_new_robot(file, path_from(folder, model), robot_path);
  const morphology::RobotGuess& guess = made.guess;
  std::optional<robot::RobotSpec>& robot = made.robot;
  fs::create_directories(folder);
  // The file ends with [contact].
  const std::string sweeps = robot ? sweeps_line(*robot) : "";
  io::write_file(robot_path, guess.toml + sweeps);
  if (!sweeps.empty()) robot = morphology::load_robot(robot_path);
  const std::string engine = robot ? engine_line(*robot) : "engine = \"batch\"\n";
  io::write_file(config_path, config_text(guess.name, engine, robot, folder));
  if (robot) fmt::print("{}", robot::summary(*robot));
  if (!made.notes.lines().empty()) fmt::print("\nimport notes:\n{}", made.notes.text());
  if (!guess.settled.empty()) fmt::print("\nsettled:\n  {}\n", fmt::join(guess.settled, "\n  "));
  if (robot)
    if (const std::string text = start_text(*robot); !text.empty()) fmt::print("\n{}", text);
  fmt::print("\nwrote {} and {}\n", robot_path.string(), config_path.string());
  if (!guess.asked.empty()) {
    fmt::print("still to be given in {}:\n", robot_path.string());
    for (const std::string& line : guess.asked) fmt::print("  {}\n", line);
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
