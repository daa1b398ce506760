#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/io/settings.hpp"

namespace amble::controllers {

enum class Kind { supg };
inline constexpr std::array<std::string_view, 1> kind_names{"supg"};

/// Which controller, and the settings of each kind.
struct ControllerSettings {
  Kind kind = Kind::supg;
  SupgSettings supg;

  void describe(io::SettingsVisitor& visitor);
};

/// Throws UserError where settings and robot do not fit.
std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const morphology::RobotSpec& robot, double timestep_s);

}  // namespace amble::controllers
