#include "amble/controllers/factory.hpp"

#include "amble/controllers/supg.hpp"
#include "amble/core/check.hpp"

namespace amble::controllers {

void ControllerSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("kind", kind, kind_names,
                 {"architecture of the controller: single-unit pattern generators (supg), static neurons "
                  "(network; with a "
                  "sine among the sensors the sine wave architecture) or continuous-time neurons (ctrnn)",
                  "Morse et al. 2013, sec. 3 and 4"});
  visitor.table("substrate", substrate,
                {"where the nodes of the controller stand, and what the CPPN says of them",
                 "Morse et al. 2013, sec. 2.2"});
  visitor.table("supg", supg, {"single-unit pattern generators", "Morse et al. 2013, sec. 3"});
  visitor.table("network", network, {"static neurons", "Morse et al. 2013, sec. 4"});
  visitor.table("ctrnn", ctrnn, {"continuous-time recurrent neural networks", "Morse et al. 2013, sec. 4"});
}

std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s) {
  switch (settings.kind) {
    case Kind::supg:
      return std::make_unique<SupgArchitecture>(settings.supg, settings.substrate, robot, timestep_s);
    case Kind::network:
      return std::make_unique<NetworkArchitecture>(settings.network, settings.substrate, robot, timestep_s);
    case Kind::ctrnn:
      return std::make_unique<CtrnnArchitecture>(settings.ctrnn, settings.substrate, robot, timestep_s);
  }
  AMBLE_CHECK(false, "unknown kind of controller");
  return nullptr;
}

}  // namespace amble::controllers
