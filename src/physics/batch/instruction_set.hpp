#pragma once

#include <string_view>

namespace amble::physics {

/// The widest instruction set, of those that kernels are compiled for, that this processor has: "AVX2" and so
/// on, by Highway's names. Results do not depend on it.
std::string_view instruction_set();

}  // namespace amble::physics
