#pragma once

#include <string>

#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/sensing.hpp"
#include "amble/experiment/problem.hpp"

namespace amble::experiment {

/// Problem::set_commands() of commands in one line (trial::parse_commands), which `what` names in messages.
/// Throws UserError: what is none, and commands that leave no time.
void tell(Problem& problem, const std::string& line, const std::string& what);

/// How a walker is steered by hand.
struct HandSteering {
  controllers::DifferentialSettings gains;  ///< [controller.differential]
  /// [controller.sensing.heading], with the key heading_lead_rad; with no lead the problem's own stays.
  controllers::HeadingSettings heading = {};

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const HandSteering&, const HandSteering&) = default;
};

/// It in one line: gains as TOML has them, with ',' or ';' between two, e.g. "turn_gain = 1.5,
/// full_speed_m_s = 0.4". `what` names the text in messages. Throws UserError: another form, a key that is
/// unknown or given twice, a value that is not in its range, gains that steer nothing.
HandSteering parse_steering(const std::string& text, const std::string& what);

/// Steers the walker of a problem so. Throws SettingError: it does not fit the robot or the controller.
void steer_by_hand(Problem& problem, const HandSteering& steering);
/// The same of such a line. Throws UserError, with `what`.
void steer_by_hand(Problem& problem, const std::string& text, const std::string& what);

}  // namespace amble::experiment
