#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/network.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/io/settings.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

enum class Kind { supg, network, ctrnn };
inline constexpr std::array<std::string_view, 3> kind_names{"supg", "network", "ctrnn"};

/// Which controller, where its nodes stand, and the settings of each kind.
struct ControllerSettings {
  Kind kind = Kind::supg;
  substrate::Settings substrate;
  SupgSettings supg;
  NetworkSettings network;
  CtrnnSettings ctrnn;

  void describe(io::SettingsVisitor& visitor);
};

/// Throws UserError where settings and robot do not fit.
std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s);

}  // namespace amble::controllers
