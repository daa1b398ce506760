#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::controllers {

/// What a leg's contact is known from: its foot's touch, the torque of a joint's motor, how far a joint is
/// behind its target, or a shock that the root feels.
enum class ContactSource { touch, torque, tracking, shock };
inline constexpr std::array<std::string_view, 4> contact_source_names{"touch", "torque", "tracking", "shock"};

/// What stands for the touch of a foot, for robots without foot switches. ContactEstimate says how.
struct ContactSettings {
  ContactSource source = ContactSource::touch;
  std::string joint_type;
  double threshold = 1.0;
  double release = 0.5;

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;
};

/// How sensors change the cycles of a leg's SUPGs; off by default. SupgArchitecture says what it does.
struct ModulationSettings {
  std::vector<std::string> sensors;
  double rate = 0.0;
  double shape = 0.0;
  double reset = 1.0;
  int refractory_ticks = 0;

  /// Whether anything differs from the paper's SUPGs.
  bool any() const { return !sensors.empty() || reset != 1.0 || refractory_ticks > 0; }
  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const ModulationSettings&, const ModulationSettings&) = default;
};

}  // namespace amble::controllers
