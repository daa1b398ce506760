#include "amble/controllers/supg_modulation.hpp"

namespace amble::controllers {

void ContactSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "source", source, contact_source_names,
      {"what a leg's contact is known from: its foot (touch), the torque of a joint's motor (torque, "
       "N m), how far a joint is from its last target (tracking, rad), or how suddenly roll and pitch "
       "change (shock, rad/s²), which is put down to the leg without a contact for longest",
       "Morse et al. 2013: touch"});
  visitor.text(
      "joint_type", joint_type,
      {"of torque and tracking: the leg's joint of this type; empty: the one with the largest number"});
  visitor.number("threshold", threshold, {0.0, 1e6},
                 {"a contact begins where that number is larger, in its unit"});
  visitor.number("release", release, {0.0, 1.0},
                 {"it ends where the number is at most this share of the threshold"});
}

void ModulationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.texts(
      "sensors", sensors,
      {"what a leg's SUPGs sense: of the leg itself touch, load, and angle.TYPE, speed.TYPE, torque.TYPE by "
       "joint type; of the robot roll, pitch, yaw, yaw_rate; command_speed, command_turn, command_stop, heading_error"});
  visitor.number("rate", rate, {0.0, 1.0},
                 {"how far sensors may change a leg's rate: a factor of 2 to the power of ± this; 0: not"});
  visitor.number("shape", shape, {0.0, 10.0},
                 {"how far one sensor may shift a target, in halves of the joint's range; 0: not"});
  visitor.number("reset", reset, {0.0, 1.0},
                 {"share of the way to start_tick that a trigger moves the timer: 1 all of it, 0 none",
                  "Morse et al. 2013: 1"});
  visitor.integer("refractory_ticks", refractory_ticks, {0, 100000},
                  {"ticks after a trigger in which a leg has no other", "Morse et al. 2013: 0"});
}

}  // namespace amble::controllers
