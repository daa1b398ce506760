#pragma once

#include <memory>
#include <string>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/network.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/io/settings.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

/// Which architecture, its substrate, and the settings of each.
struct ControllerSettings {
  std::string kind = "supg";  ///< a row of the table in factory.cpp
  substrate::Settings substrate;
  SupgSettings supg;
  NetworkSettings network;
  CtrnnSettings ctrnn;

  void describe(io::SettingsVisitor& visitor);
};

/// The substrate with its lists: those of the settings, or with `layout = "auto"` those that the row of the
/// settings' kind makes from the robot (automatic.hpp). Throws SettingError where both are given.
substrate::Settings substrate_of(const ControllerSettings& settings, const robot::RobotSpec& robot);

/// By the row of the settings' kind. Throws UserError where settings and robot do not fit.
std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s);

}  // namespace amble::controllers
