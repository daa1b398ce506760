#pragma once

#include "tests/controllers/quadruped.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::controllers {

/// That of configs/parts/supg.toml.
inline substrate::Settings supg_substrate() {
  return substrate::part("supg");
}

}  // namespace amble::controllers
