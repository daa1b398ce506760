#include "amble/cli/robot_solver.hpp"

#include <fmt/format.h>

#include "amble/core/error.hpp"
#include "amble/physics/solver_error.hpp"

namespace amble::cli {
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

}  // namespace

std::optional<std::string> solver_line(const robot::RobotSpec& robot) {
  const auto advice = advice_for(robot);
  if (!advice) return std::nullopt;
  std::string line = fmt::format("solver of the batch engine: {} sweeps, error of a step {:.2g} m/s\n",
                                 advice->sweeps, advice->error_m_s);
  if (advice->better_sweeps > advice->sweeps)
    line += fmt::format(
        "  That is much: gaits would live on it and not carry over to other engines. Set contact.sweeps = {} "
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

}  // namespace amble::cli
