#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

struct ServoGuess {
  robot::Servo servo;
  std::string why;
  bool torque_is_guessed = false;   ///< the model has no limit, or one that is no motor's
  bool speed_is_guessed = false;    ///< the same of a URDF's limit of speed
  bool lacks_gear = false;          ///< its torque is that of a control of ±1 with a gear of 1
  bool has_no_speed_limit = false;  ///< a position actuator: as fast as its torque allows
  bool torque_is_geared = false;    ///< a position actuator's force times its gear
  /// Of the targets that the model lets its motor have, as the model counts angles: ctrlrange of a position
  /// actuator, soft limits of a URDF.
  std::optional<std::array<double, 2>> target_range_rad = {};
  std::string uneven_force = {};  ///< an actuator's range of force that is not the same to both sides
  bool acts_to_one_side = false;  ///< and that does not pass 0
  std::string oddity = {};        ///< what its actuator does that no servo of an angle does
};

/// The torque with which a leg of that length bears its share of the robot's weight at right angles.
double bearing_torque_nm(const ModelParts& parts, std::size_t legs, double leg_length_m);

/// The servo of each of the parts' joints: of the model's actuator, else of a URDF's effort limit, else such
/// that the robot can rise: twice the bearing torque.
std::vector<ServoGuess> guess_servos(const ModelFile& file, const ModelParts& parts, double bearing_nm);

/// The gain of a velocity servo that keeps to a limit of speed, as far as targets usually are; that of the
/// paper's motors if that is less, or without a limit (0).
double gain_within(double max_speed_rad_s);

/// Lines on joints with motors whose torque or speed was guessed, whose actuators lack a gear, or are too
/// strong to be of such a robot.
std::vector<std::string> doubts_of_motors(const ModelFile& file, const ModelParts& parts,
                                          const std::vector<ServoGuess>& servos, double bearing_nm);

/// Notes on joints whose servo has another torque or speed than the limits of their URDF give: after one of
/// them was corrected, the robot file has the say.
void note_other_limits(const ModelFile& file, const robot::RobotSpec& robot, ReadingNotes& notes);

/// The names of those of these joints behind which hangs next to nothing, less than a ten-thousandth of the
/// robot's mass, as at a finger of milligrams: a motor that holds them makes a simulation diverge.
std::vector<std::string> joints_of_tiny_links(const ModelParts& parts, const std::vector<int>& joints);

/// A line about those of these joints whose limit of speed, in a URDF, is so low that legs of that length
/// hardly move, as templates have it; empty: none is.
std::string slow_joints(const ModelFile& file, const ModelParts& parts, const std::vector<int>& joints,
                        double leg_length_m);

}  // namespace amble::morphology
