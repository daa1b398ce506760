#pragma once

#include "amble/io/settings.hpp"

namespace amble::controllers {

/// How strongly the links of a mixed substrate act on SUPGs: what one source that says 1 changes by the
/// greatest weight. 0: not at all.
struct MixedSettings {
  double rate = 1.0;       ///< ρ: the period by a factor of two
  double amplitude = 1.0;  ///< of the pattern about the middle of the joint's range: once more, or none
  double shift = 0.5;      ///< of the target, in halves of the joint's range
  double coupling = 1.0;   ///< ρ, a quarter of a period off

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const MixedSettings&, const MixedSettings&) = default;
};

}  // namespace amble::controllers
