#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

/// Groups of the nodes below: what is the same on both sides, what tells left from right, and legs' neurons.
inline constexpr const char *sense_group = "sense", *turn_group = "turn", *leg_neurons = "hidden";

/// Gives each module of an automatic CTRNN (automatic_ctrnn()) nodes that sense: of the leg itself load, and
/// angle.TYPE, speed.TYPE, torque.TYPE by joint type, and all that the robot has one of (pitch, command_speed
/// …). They lie at y −2, evenly spread in x, and are linked with all neurons of their module by a CPPN output
/// of their own, `sense`; what tells left from right (roll, yaw, yaw_rate, command_turn, heading_error) by
/// `turn`, times module_x where modules have sides, so that one constant output of a CPPN is enough to steer.
/// Throws SettingError for a name that is not one of these, or is there twice.
void add_module_senses(const robot::RobotSpec& robot, const std::vector<std::string>& sensors,
                       substrate::Settings& made);

/// A bias that no output of the CPPN gives, as motors of an automatic CTRNN have.
bool has_constant_bias(const substrate::PropertySettings& item);

/// Gives the motors of an automatic CTRNN biases of −3 to 3 by the CPPN's output for those of hidden nodes,
/// in place of 3.
void evolve_motor_biases(substrate::Settings& made);

/// A neuron of an automatic mixed substrate.
bool is_leg_neuron(const substrate::NodeSettings& node);

/// Takes the neurons out of an automatic mixed substrate (automatic_mixed()), with all that leads to them and
/// from them, and the touch sensors, which lead to nothing else.
void remove_neurons(substrate::Settings& made);

}  // namespace amble::controllers
