#pragma once

#include "amble/analysis/cppn_graph.hpp"
#include "amble/experiment/champion.hpp"

namespace amble::cli {

/// The CPPN of a champion, with the names that its controller gives to inputs and outputs.
analysis::CppnGraph cppn_graph(const experiment::Champion& champion);

}  // namespace amble::cli
