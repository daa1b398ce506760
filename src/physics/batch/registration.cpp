#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/batch/state_rows.hpp"
#include "amble/physics/engine_kinds.hpp"

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_batch;
const bool amble_registers_physics_batch = [] {
  amble::physics::register_engine({.name = "batch",
                                   .traits = {.lanes = amble::physics::batch::lanes},
                                   .make = amble::physics::make_batch_engine});
  return true;
}();
