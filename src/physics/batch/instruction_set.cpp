#include "amble/physics/batch/instruction_set.hpp"

// First: which instruction sets there are.
#include "amble/core/simd_targets.hpp"

#include <hwy/highway.h>

namespace amble::physics {

std::string_view instruction_set() {
  const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & -usable);  // the best is the lowest bit
}

}  // namespace amble::physics
