#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/ode/ode_engine.hpp"

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_ode;
const bool amble_registers_physics_ode = [] {
  // ODE has data of its own for each thread.
  amble::physics::register_engine({.name = "ode",
                                   .traits = {.lanes = 1, .keeps_to_a_thread = true},
                                   .make = amble::physics::make_ode_engine});
  return true;
}();
