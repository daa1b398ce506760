#include "amble/physics/engine.hpp"

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/ode/ode_engine.hpp"

namespace amble::physics {

std::unique_ptr<Engine> make_engine(std::string_view name, const morphology::RobotSpec& robot,
                                    const EngineSettings& settings) {
  AMBLE_CHECK(settings.timestep_s > 0.0, "timestep_s");
  AMBLE_CHECK(settings.iterations > 0, "iterations");
  if (name == "ode") return make_ode_engine(robot, settings);
  if (name == "batch") return make_batch_engine(robot, settings);
  fail(ExitCode::bad_input, "unknown engine '{}': expected ode or batch", name);
}

}  // namespace amble::physics
