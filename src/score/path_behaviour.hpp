#pragma once

#include <cstddef>
#include <vector>

#include "amble/record/trajectory.hpp"

namespace amble::score {

/// Numbers in the behaviour of a trial of so many steps.
std::size_t path_behaviour_length(int steps, const record::PathSampling& sampling);

/// What a robot did, for novelty search (Morse et al. 2013, sec. 4): the path of its centre of mass over the
/// ground, x0, y0, x1, y1, …, m, relative to the start, as it was sampled. A trial that ended early is padded
/// with its last centre of mass to `length` numbers.
std::vector<float> path_behaviour(const record::Trajectory& trajectory, std::size_t length);

}  // namespace amble::score
