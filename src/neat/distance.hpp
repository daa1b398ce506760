#pragma once

#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// The compatibility distance of Stanley & Miikkulainen 2002, eq. 1: excess · E + disjoint · D + weight · W.
/// E counts the links of one genome that are newer than all of the other's, D the other links that only one
/// has; W is the sum of |weight difference| over the links of both. If settings.normalised, E and D are
/// divided by the larger genome's number of links and W by the number of links of both. Disabled links count
/// like others. Symmetric, ≥ 0.
double compatibility_distance(const Genome& a, const Genome& b, const DistanceSettings& settings);

}  // namespace amble::neat
