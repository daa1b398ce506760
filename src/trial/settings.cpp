#include "amble/trial/settings.hpp"

#include <cmath>

#include "amble/core/error.hpp"

namespace amble::trial {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.number("duration_s", duration_s, {1e-3, 1e6},
                 {"length of a trial that does not end in a fall, s", "Morse et al. 2013, sec. 4"});
  visitor.number("timestep_s", timestep_s, {1e-5, 0.1},
                 {"one simulation step and one controller update, s",
                  "Morse et al. 2013, sec. 4 (1,500 steps in 15 s)"});
  visitor.choice(
      "first_command", first_command, first_command_names,
      {"the controller acts before the first step, or only after it; then the motors hold the joints "
       "where they are during the first",
       "the authors' code: after_first_step"});
  visitor.number("fall_factor", fall_factor, {0.0, 1.0},
                 {"share of the distance that counts in evolution if the robot falls",
                  "Morse et al. 2013 and the authors' code: all of it (1)"});
}

void Settings::validate() const {
  const double exact = duration_s / timestep_s;
  const bool whole = exact >= 0.5 && exact <= 1e9 && std::abs(exact - std::round(exact)) <= 1e-6 * exact;
  if (!whole)  // NaN is none either
    fail_setting({"trial.duration_s", "trial.timestep_s"},
                 "trial.duration_s = {}: expected a whole number of timesteps of {} s, at most 1e9",
                 duration_s, timestep_s);
}

int Settings::steps() const {
  return static_cast<int>(std::lround(duration_s / timestep_s));
}

}  // namespace amble::trial
