#pragma once

#include "amble/experiment/champion.hpp"
#include "amble/figures/cppn_graph.hpp"

namespace amble::presentation {

/// The CPPN of a champion, with the names that its controller gives to inputs and outputs.
figures::CppnGraph cppn_graph(const experiment::Champion& champion);

}  // namespace amble::presentation
