#include "amble/experiment/robot_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/new_robot.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/physics/batch/solver_error.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"
#include "amble/robot/doubts.hpp"
#include "amble/robot/summary.hpp"

namespace amble::experiment {
namespace {

constexpr double timestep_s = 0.01;  // that of the presets
/// Of the swing of the inner legs, at the greatest turn, where a robot is steered by hand.
constexpr double most_slowing = 0.6;

std::optional<physics::SweepsAdvice> advice_for(const robot::RobotSpec& robot) {
  if (robot.joints.empty()) return std::nullopt;
  try {
    return physics::sweeps_advice(robot, timestep_s);
  } catch (const UserError&) {
    return std::nullopt;
  }
}

/// How the robot starts in its own model, and what of it the engine mujoco-model does otherwise.
std::string original_model_text(const robot::RobotSpec& robot, const std::vector<std::string>& odd_anyway) {
  constexpr const char* engine = "mujoco-model";
  try {
    std::vector<std::string> lines = physics::original_model_notes(robot, timestep_s);
    bool odd = false;
    for (std::string& line : odd_at_start(robot, engine, timestep_s)) {
      if (std::ranges::count(odd_anyway, line) > 0) continue;
      lines.push_back(std::move(line));
      odd = true;
    }
    if (!odd && !robot.legs.empty())
      lines.emplace_back(odd_pose(robot, engine, timestep_s).empty()
                             ? "held for a second in its start pose, it stands"
                             : "held in its start pose it does what is said above");
    return fmt::format("in its own model, engine {}:\n  {}\n", engine, fmt::join(lines, "\n  "));
  } catch (const UserError& error) {
    return fmt::format("{}\n", error.what());
  }
}

/// Of a URDF it is said where its limits are read.
void warn_of_endless_joints(const robot::RobotSpec& robot, std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const robot::Joint& joint : robot.joints)
    if (joint.driven() && std::isinf(joint.lower_rad) && std::isinf(joint.upper_rad))
      names.push_back(joint.name);
  if (!names.empty())
    warnings.push_back(fmt::format("joints without a range: they have no stops: {}", fmt::join(names, ", ")));
}

void warn_of_missing_presets(RobotFolder& written) {
  written.warnings.push_back(fmt::format(
      "the presets of amble were not found: {} includes {}, which is not there; they are in amble's folder "
      "configs/: correct the path, or use amble where it was built or installed",
      written.config_file.string(), robot_preset));
}

namespace fs = std::filesystem;

/// A path as a file in `folder` names it.
std::string path_from(const fs::path& folder, const fs::path& path) {
  const fs::path relative = fs::relative(fs::absolute(path), fs::absolute(folder));
  return (relative.empty() ? fs::absolute(path) : relative).generic_string();
}

std::string engine_line(const robot::RobotSpec& robot) {
  const EngineChoice choice = fastest_engine(robot);
  if (choice.engine == "batch") return "engine = \"batch\"\n";
  return fmt::format("engine = \"{}\"  # not batch, which is faster: {}\n", choice.engine,
                     choice.why_not_batch);
}

/// As many as studies/defaults.toml gave the robots of docs/ROBOTS.md.
constexpr int generations_of_a_minute = 300;
/// Length of a controller's tick in the presets.
constexpr double tick_s = 0.01;

/// What a config of a robot on one or two legs has besides: by distance alone the first generations learn to
/// fall far.
constexpr const char* score_of_two_legs =
    "\n"
    "[score]  # in m; on two legs a fall forwards is the first to win by distance alone\n"
    "terms = [{ quantity = \"distance\", weight = 1.0 }, { quantity = \"upright_time\", weight = 1.0 }]\n";

std::string settings_text(const robot::RobotSpec& robot) {
  const auto settings = settings_of_size(robot);
  if (!settings) return {};
  const std::string hips = fmt::format("hips {:.2g} m over the feet", settings->leg_height_m);
  const std::string why =
      settings->servo_lag_s > 0.0
          ? fmt::format("three times the {:.2g} s that the motors take to follow, at most 5 s",
                        settings->servo_lag_s)
          : fmt::format("{}; 1 s where they are {:g} m, by the square root (Froude)", hips,
                        settings->preset_leg_height_m);
  return fmt::format(
      "\n"
      "[controller.supg]\n"
      "period_s = {:g}  # {}\n"
      "# trigger_debounce_ticks = {:.0f}  # fewer, longer steps, slower: a foot off the ground for a tenth "
      "of the period triggers\n"
      "\n"
      "[noise]  # what the preset's pushes and drops are for a robot of that size{}\n"
      "push_m_s = {:.2g}\n"
      "start_height_m = {:.2g}\n",
      settings->period_s, why, std::max(1.0, 0.1 * settings->period_s / tick_s),
      settings->servo_lag_s > 0.0 ? ", " + hips : "", settings->push_m_s, settings->start_height_m);
}

std::string config_text(const std::string& name, const std::string& engine,
                        const std::optional<robot::RobotSpec>& robot, const fs::path& folder,
                        const std::optional<fs::path>& preset) {
  const std::size_t legs = robot ? robot->legs.size() : 0;
  return fmt::format(
      "# {0}: SUPGs under noise. Beside the preset are sine.toml and ctrnn.toml; `amble settings` lists all "
      "that may be set.\n"
      "{1}include = [{2}]\n"
      "name = {3}\n"
      "robot = {4}\n"
      "{5}"
      "generations = {8}  # a minute on two cores\n"
      "\n"
      "[controller]\n"
      "substrate = \"auto\"  # a node for each joint, made from the robot's legs and joint types\n"
      "{6}{7}",
      io::printable(name), preset ? "" : "# The presets of amble were not found: correct this path.\n",
      io::toml_quoted(preset ? path_from(folder, *preset) : robot_preset), io::toml_quoted(name),
      io::toml_quoted(name + ".toml"), engine, robot ? settings_text(*robot) : "",
      legs == 1 || legs == 2 ? score_of_two_legs : "", generations_of_a_minute);
}

/// The config of a robot that is told where to go.
std::string steer_text(const std::string& name, const CommandSizes& sizes, const fs::path& folder,
                       const std::optional<fs::path>& preset) {
  const fs::path part = preset ? preset->parent_path() / steer_part : fs::path("configs/parts/steer.toml");
  return fmt::format(
      "# {0}, told a speed and a turn: SUPGs, neurons and sensors in one substrate (docs/STEERING.md).\n"
      "include = [\"evolve.toml\", {1}]\n"
      "name = {2}\n"
      "\n"
      "[command]  # by the hips, {3:.2g} m over the feet: 0.2 √(g h) and 0.05 √(g / h)\n"
      "least_speed_m_s = {4:.2g}\n"
      "most_speed_m_s = {5:.2g}\n"
      "most_turn_rad_s = {6:.2g}\n"
      "\n"
      "[controller.sensing]  # the greatest command reads 1\n"
      "sensors = [{{ of = \"command_speed\", scale = {7:.3g} }}, {{ of = \"command_turn\", scale = {8:.3g} "
      "}}]\n"
      "\n"
      "[score.tracking]\n"
      "speed_m_s = {9:.2g}\n"
      "turn_rad_s = {6:.2g}\n"
      "\n"
      "# Does it walk and not obey? Steered by hand while it evolves (docs/STEERING.md), a Go2 did better "
      "after a minute:\n"
      "#   --set controller.kind=supg --set controller.differential.turn_gain={10:.2g} "
      "--set controller.differential.full_speed_m_s={5:.2g}\n",
      io::printable(name), io::toml_quoted(preset ? path_from(folder, part) : part.string()),
      io::toml_quoted(name + ", steered"), sizes.leg_height_m, 0.25 * sizes.most_speed_m_s,
      sizes.most_speed_m_s, sizes.most_turn_rad_s, 1.0 / sizes.most_speed_m_s, 1.0 / sizes.most_turn_rad_s,
      0.5 * sizes.most_speed_m_s, most_slowing / sizes.most_turn_rad_s);
}

/// What was read and guessed, and what to do next.
std::string text_of(const RobotFolder& written, const NewRobot& made, const fs::path& folder) {
  const std::string file = written.robot_file.string();
  std::string text;
  const auto out = std::back_inserter(text);
  if (made.robot) text += robot::summary(*made.robot);
  if (!made.notes.lines().empty()) fmt::format_to(out, "\nimport notes:\n{}", made.notes.text());
  if (!written.settled.empty()) fmt::format_to(out, "\nsettled:\n  {}\n", fmt::join(written.settled, "\n  "));
  if (made.robot)
    if (const std::string start = start_text(*made.robot); !start.empty()) text += "\n" + start;
  if (written.steer_file.empty())
    fmt::format_to(out, "\nwrote {} and {}\n", file, written.config_file.string());
  else
    fmt::format_to(out, "\nwrote {}, {} and {}\n", file, written.config_file.string(),
                   written.steer_file.string());
  if (!written.asked.empty())
    fmt::format_to(out, "still to be given in {}:\n  {}\n", file, fmt::join(written.asked, "\n  "));
  text += doubts_text(written.warnings);
  const auto command = [&](const fs::path& config, const char* run) {
    return fmt::format("  amble evolve {} --out {}", io::shell_word(config.string()),
                       io::shell_word((folder / run).string()));
  };
  if (written.ready) {
    fmt::format_to(out, "next: read {}, look at the robot, and evolve it\n  amble robot {} --draw {}\n{}\n",
                   file, io::shell_word(file),
                   io::shell_word(fs::path(file).replace_extension(".svg").string()),
                   command(written.config_file, "run"));
    if (!written.steer_file.empty())
      fmt::format_to(out, "or, to tell it where to go:\n{}\n", command(written.steer_file, "steered"));
  } else {
    fmt::format_to(out, "next: complete it, and check it with\n  amble robot {}\n", io::shell_word(file));
  }
  return text;
}

void refuse_to_replace_any(const std::vector<fs::path>& files) {
  std::vector<std::string> there;
  for (const fs::path& file : files)
    if (fs::exists(file)) there.push_back(file.string());
  if (there.empty()) return;
  const bool one = there.size() == 1;
  fail(ExitCode::bad_input,
       "{} {} there already, and {} not replaced: delete {} first, or name another folder with -o",
       fmt::join(there, ", "), one ? "is" : "are", one ? "is" : "are", one ? "it" : "them");
}

}  // namespace

std::optional<std::string> solver_line(const robot::RobotSpec& robot) {
  const auto advice = advice_for(robot);
  if (!advice) return std::nullopt;
  std::string line = fmt::format("solver of the batch engine: {} sweeps, error of a step {:.2g} m/s\n",
                                 advice->sweeps, advice->error_m_s);
  if (advice->better_sweeps > advice->sweeps)
    line += fmt::format(
        "  That is much: gaits would exploit it and not carry over to other engines. Set contact.sweeps = {} "
        "({:.2g} m/s).\n",
        advice->better_sweeps, advice->better_error_m_s);
  return line;
}

std::string sweeps_line(const robot::RobotSpec& robot) {
  const auto advice = advice_for(robot);
  if (!advice || advice->better_sweeps == advice->sweeps) return "";
  return fmt::format(
      "sweeps = {}  # {} leave an error of {:.2g} m/s in a step of the batch engine; this {:.2g}\n",
      advice->better_sweeps, advice->sweeps, advice->error_m_s, advice->better_error_m_s);
}

std::string doubts_text(const std::vector<std::string>& doubts) {
  std::string text = doubts.empty() ? "" : "warnings:\n";
  for (const std::string& line : doubts) text += "  " + line + "\n";
  return text;
}

std::string start_text(const robot::RobotSpec& robot) {
  const auto odd = odd_at_start(robot, fastest_engine(robot).engine, timestep_s);
  std::string text;
  if (!odd.empty())
    text = fmt::format("look at its start before you evolve:\n  {}\n", fmt::join(odd, "\n  "));
  else if (!robot.legs.empty())
    text = "start: held for a second in its start pose, it stands\n";
  if (robot.original) text += original_model_text(robot, odd);
  return text;
}

std::optional<RobotFolder> write_robot_folder(const fs::path& model, fs::path folder,
                                              const std::optional<fs::path>& preset,
                                              const std::atomic<bool>& stop) {
  io::refuse_other_kinds(model, io::FileKind::model, "and not a model, MJCF (.xml) or URDF (.urdf)");
  if (folder.empty()) folder = model.stem();
  const morphology::ModelFile file = morphology::compile_model(model);
  RobotFolder written;
  written.robot_file = folder / (model.stem().string() + ".toml");
  written.config_file = folder / "evolve.toml";
  for (const char* config : {"evolve", "steer"})
    if (model.stem() == config)
      fail(ExitCode::bad_input, "{}: the model must not be called {}, as a config is", model.string(),
           config);
  const fs::path steer_file = folder / "steer.toml";
  refuse_to_replace_any({written.robot_file, written.config_file, steer_file});
  if (stop) return std::nullopt;
  NewRobot made = make_new_robot(file, path_from(folder, model), written.robot_file);
  if (stop) return std::nullopt;
  std::optional<robot::RobotSpec>& robot = made.robot;
  io::make_folder(folder);
  // The file ends with [contact].
  const std::string sweeps = robot ? sweeps_line(*robot) : "";
  io::write_file(written.robot_file, made.guess.toml + sweeps);
  if (!sweeps.empty()) robot = morphology::load_robot(written.robot_file);
  const std::string engine = robot ? engine_line(*robot) : "engine = \"batch\"\n";
  io::write_file(written.config_file, config_text(made.guess.name, engine, robot, folder, preset));
  if (const auto sizes = robot ? commands_of_size(*robot) : std::nullopt) {
    written.steer_file = steer_file;
    io::write_file(steer_file, steer_text(made.guess.name, *sizes, folder, preset));
  }
  if (stop) return std::nullopt;
  written.settled = made.guess.settled;
  written.asked = made.guess.asked;
  written.warnings = made.guess.doubts;
  if (robot) std::ranges::copy(robot::doubts(*robot), std::back_inserter(written.warnings));
  if (robot && model.extension() != ".urdf") warn_of_endless_joints(*robot, written.warnings);
  if (!preset) warn_of_missing_presets(written);
  written.ready = robot && !robot->legs.empty();
  written.text = text_of(written, made, folder);
  return written;
}

}  // namespace amble::experiment
