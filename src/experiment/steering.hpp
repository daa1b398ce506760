#pragma once

#include <string>

#include "amble/controllers/kind_settings.hpp"
#include "amble/experiment/problem.hpp"

namespace amble::experiment {

/// Problem::set_commands() of commands in one line (trial::parse_commands), which `what` names in messages.
/// Throws UserError: what is none, and commands that leave no time.
void tell(Problem& problem, const std::string& line, const std::string& what);

/// [controller.differential] in one line: gains as TOML has them, with ',' or ';' between two, e.g.
/// "turn_gain = 1.5, full_speed_m_s = 0.4". `what` names the text in messages. Throws UserError: another
/// form, a key that is unknown or given twice, a value that is not in its range, gains that steer nothing.
controllers::DifferentialSettings parse_differential(const std::string& text, const std::string& what);

/// Problem::set_differential() of such a line. Throws UserError, with `what`, also for gains that do not fit
/// the robot or the controller.
void steer_by_hand(Problem& problem, const std::string& text, const std::string& what);

}  // namespace amble::experiment
