#pragma once

#include "amble/cppn/network.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

/// How far the outputs of a CPPN depend on the precision they are computed in: the largest change of any
/// output, as substrates use it (clamped to −1 … 1), at any of the points, when it is evaluated in double
/// precision (Reference) in place of single (Network). From 0 to 2. About 1e-6 where the CPPN has no cycle; a
/// CPPN with cycles can be chaotic, and then has no value beyond the precision it is computed in.
double precision_sensitivity(const neat::Genome& genome, const Settings& settings, const Points& points);

}  // namespace amble::cppn
