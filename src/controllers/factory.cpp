#include "amble/controllers/factory.hpp"

#include "amble/controllers/supg.hpp"
#include "amble/core/check.hpp"

namespace amble::controllers {

void ControllerSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("kind", kind, kind_names, {"architecture of the controller", "Morse et al. 2013, sec. 3"});
  visitor.table("supg", supg, {"single-unit pattern generators", "Morse et al. 2013, sec. 3"});
}

std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const morphology::RobotSpec& robot, double timestep_s) {
  switch (settings.kind) {
    case Kind::supg:
      return std::make_unique<SupgArchitecture>(settings.supg, robot, timestep_s);
  }
  AMBLE_CHECK(false, "unknown kind of controller");
  return nullptr;
}

}  // namespace amble::controllers
