#pragma once

#include "amble/record/trajectory.hpp"

namespace amble::score {

/// How far the whole-body centre of mass came over the ground, in any direction, m; for a robot that fell, to
/// where it fell; 0 for a trial that diverged, where the simulation broke down. The objective of Morse et al.
/// 2013, sec. 4.
double distance_m(const record::Trajectory& trajectory);

/// What a distance counts for in evolution, m: `fall_factor` of it if the robot fell.
double credited_m(double distance_m, record::Outcome outcome, double fall_factor);

}  // namespace amble::score
