#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/mujoco/mujoco_engine.hpp"

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_mujoco;
const bool amble_registers_physics_mujoco = [] {
  amble::physics::register_engine(
      {.name = "mujoco", .traits = {.lanes = 1}, .make = amble::physics::make_mujoco_engine});
  return true;
}();
