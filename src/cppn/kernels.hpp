#pragma once

#include <cstddef>

#include "amble/core/index.hpp"
#include "amble/cppn/network.hpp"

/// The inner loops, compiled for several instruction sets; the best that the CPU has is chosen at run time.
namespace amble::cppn {

/// Values of one slot at the points of one block: a few vector registers, and whole cache lines.
struct alignas(64) Tile {
  float value[Points::block];
};

/// Number of tiles that run_program needs.
inline std::size_t scratch_tiles(const Program& program) {
  return to_index(program.slots) * (program.in_place ? 1 : 2);
}

/// Network::evaluate, with scratch_tiles(program) tiles of any content.
void run_program(const Program& program, const Points& points, float* results, Tile* scratch);

/// activate() on `count` values.
void activate_array(neat::Activation function, Linear linear, float* values, std::size_t count);

}  // namespace amble::cppn
