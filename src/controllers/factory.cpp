#include "amble/controllers/factory.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "amble/controllers/supg.hpp"
#include "amble/core/check.hpp"

namespace amble::controllers {
namespace {

struct ArchitectureKind {
  std::string_view name;  ///< value of controller.kind
  std::unique_ptr<const Architecture> (*make)(const ControllerSettings& settings,
                                              const robot::RobotSpec& robot, double timestep_s);
};

/// Makes a Kind from the substrate and its own settings.
template <typename Kind, auto own_settings>
std::unique_ptr<const Architecture> make(const ControllerSettings& settings, const robot::RobotSpec& robot,
                                         double timestep_s) {
  return std::make_unique<Kind>(settings.*own_settings, settings.substrate, robot, timestep_s);
}

// The table of architectures. A new one is a row here, a class derived from Architecture, and, if it has
// settings, a member of ControllerSettings with its line below.
constexpr std::array kinds{
    ArchitectureKind{"supg", make<SupgArchitecture, &ControllerSettings::supg>},
    ArchitectureKind{"network", make<NetworkArchitecture, &ControllerSettings::network>},
    ArchitectureKind{"ctrnn", make<CtrnnArchitecture, &ControllerSettings::ctrnn>},
};

}  // namespace

void ControllerSettings::describe(io::SettingsVisitor& visitor) {
  visitor.row_name(
      "kind", kind, kinds,
      {"architecture of the controller: single-unit pattern generators (supg), static neurons "
       "(network; with a sine among the sensors the sine wave architecture) or continuous-time neurons "
       "(ctrnn)",
       "Morse et al. 2013, sec. 3 and 4"});
  visitor.table(
      "substrate", substrate,
      {"the nodes of the controller, and what the CPPN says of them", "Morse et al. 2013, sec. 2.2"});
  visitor.table("supg", supg, {"single-unit pattern generators", "Morse et al. 2013, sec. 3"});
  visitor.table("network", network, {"static neurons", "Morse et al. 2013, sec. 4"});
  visitor.table("ctrnn", ctrnn, {"continuous-time recurrent neural networks", "Morse et al. 2013, sec. 4"});
}

std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s) {
  const auto row = std::ranges::find(kinds, settings.kind, &ArchitectureKind::name);
  AMBLE_CHECK(row != kinds.end(), "controller.kind is one of the table's");
  return row->make(settings, robot, timestep_s);
}

}  // namespace amble::controllers
