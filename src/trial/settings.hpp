#pragma once

#include <string>

#include "amble/io/settings.hpp"

namespace amble::trial {

/// One trial: a robot walks on flat ground for a while, or until it falls.
struct Settings {
  double duration_s = 15.0;
  double timestep_s = 0.01;

  void describe(io::SettingsVisitor& visitor);
  /// Throws UserError if the duration is not a whole number of timesteps, at least one and at most 1e9.
  void validate() const;
  /// Steps of a trial that completes.
  int steps() const;
};

}  // namespace amble::trial
