#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_mujoco_model;
const bool amble_registers_physics_mujoco_model = [] {
  amble::physics::register_engine({.name = "mujoco-model",
                                   .traits = {.lanes = 1, .of_original_model = true},
                                   .make = amble::physics::make_mujoco_model_engine});
  return true;
}();
