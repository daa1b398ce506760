#include "amble/experiment/robot_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/experiment/new_robot.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/physics/batch/solver_error.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"

namespace amble::experiment {
namespace {

constexpr double timestep_s = 0.01;  // that of the presets

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
    if (!odd && !robot.legs.empty()) lines.emplace_back("held for a second in its start pose, it stands");
    return fmt::format("in its own model, engine {}:\n  {}\n", engine, fmt::join(lines, "\n  "));
  } catch (const UserError& error) {
    return fmt::format("{}\n", error.what());
  }
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

}  // namespace amble::experiment
