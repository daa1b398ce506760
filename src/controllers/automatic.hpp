#pragma once

#include "amble/robot/spec.hpp"
#include "amble/substrate/settings.hpp"

/// Substrates made from a robot's legs and joints: `layout = "auto"`.
///
/// For the quadruped they are those of configs/parts, that is of Morse et al. 2013, figures 4, 6 and 7. Each
/// function returns the lists (coordinates, outputs, nodes, links, properties); all else is at its defaults.
/// Legs and joint types come in control order, and a type that no leg drives is left out. A leg without a
/// joint of some type, or whose joint is held, has no node there, and all other nodes keep their places.
///
/// "Evenly spread" below means from −1 to 1 with both ends, and 0 for one alone. "Across" is an order of the
/// joint types in which the first ones are at the edges and the last in the middle: 1st, 3rd, …, 4th, 2nd;
/// right legs have it the other way round. Pairs of left and right legs are those of robot::leg_pairs() for
/// the hips in the start pose.
namespace amble::controllers {

/// One SUPG per driven joint at (leg, joint_type): joint types evenly spread, legs evenly spread and divided
/// by 50, so that SUPGs of one type are close together (figure 4).
substrate::Settings automatic_supg(const robot::RobotSpec& robot);

/// The sine wave architecture (figure 6): three planes with one row per leg, at i/(n/2) for n legs, without 0
/// if n is even. A row of the input plane senses the leg's joint angles (across, as of a right leg) and its
/// touch. Pitch, roll, yaw and sine go to the rows in turn, one after the other: with fewer than four legs
/// some rows have several of them, and with more some have none. Columns are evenly spread, as many as the
/// longest row needs; the hidden plane is full, and the output plane has the motors across from column 1 on.
substrate::Settings automatic_network(const robot::RobotSpec& robot);

/// The CTRNN architecture (figure 7): one module per leg with a touch sensor at the bottom, two hidden nodes,
/// and its motors across the top. Modules lie at module_x −1 (left) and 1 (right), and at module_y from −1
/// (hindmost) to 1 (foremost) as the hips do, two of a pair at the mean of both. The top of each module is
/// linked with the bottom of the one in front of it, and facing hidden nodes and motors of a pair with each
/// other. Without pairs the modules are one behind the other, evenly spread.
substrate::Settings automatic_ctrnn(const robot::RobotSpec& robot);

/// SUPGs as automatic_supg() has them, with side (1 left, −1 right) and layer (1) as further coordinates,
/// which are 0 for patterns and offsets: without links they are the same. A commanded stop, speed and turn,
/// heading error and yaw rate are sensed at layer −1, each leg's touch at −0.5, and each leg has two neurons
/// at 0. Sensors lead to neurons, and neurons to each other; all but touches lead to each leg's rate, by its
/// first SUPG, and to the amplitude and shift of each SUPG, those that tell left from right (turn, heading,
/// yaw rate) by CPPN outputs of their own and times the SUPG's side; the first SUPGs of legs are coupled.
substrate::Settings automatic_mixed(const robot::RobotSpec& robot);

}  // namespace amble::controllers
