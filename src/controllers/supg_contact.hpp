#pragma once

#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/core/lanes.hpp"
#include "amble/robot/sensors.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/sensor.hpp"

namespace amble::controllers {

/// Which joints' numbers tell of a leg's contact. Throws SettingError for a joint type that the robot lacks,
/// or that one of its legs lacks.
std::vector<std::vector<int>> contact_joints(const ContactSettings& settings, const robot::RobotSpec& robot);

/// Whether contacts of this source are told by sensors of that kind.
bool tells_contact(ContactSource source, substrate::Sensor::Kind kind);

/// The contacts of legs without foot switches: 1 or 0 by lane, as a touch is. With x the number that tells,
///   torque    |torque| of the leg's motor in the last step (the largest of several), N m
///   tracking  |target − angle| of the last tick's target and this tick's angle, likewise, rad
/// a contact begins with x > threshold and ends with x ≤ release × threshold. With
///   shock     |Δ²roll| + |Δ²pitch| by the tick's square, rad/s², from the third tick on
/// a contact lasts for the tick in which x > threshold, and is that of the leg whose last is longest ago; of
/// several the first. Single precision, each operation rounded.
class ContactEstimate {
 public:
  ContactEstimate(const ContactSettings& settings, std::vector<std::vector<int>> joints, double timestep_s,
                  int lanes);

  void load(int lane);
  /// From this tick's sensors, before targets().
  void update(const robot::SensorFrame& sensors);
  /// The targets of this tick.
  void targets(const LaneArray& targets_rad);
  /// The rows of all legs follow each other, as those of SensorFrame::touch.
  const float* row(int leg) const { return contact_.row(leg); }
  int legs() const { return static_cast<int>(joints_.size()); }

  robot::ExtraSenses extra_senses() const { return {.torque = settings_.source == ContactSource::torque}; }

 private:
  void update_leg(int leg, const robot::SensorFrame& sensors);
  void update_shock(const robot::SensorFrame& sensors);

  ContactSettings settings_;
  std::vector<std::vector<int>> joints_;
  int lanes_;
  float begins_, ends_, per_tick_squared_;
  LaneArray contact_;          ///< leg by leg
  LaneRows number_;            ///< of one leg: scratch
  LaneArray targets_rad_;      ///< of the last tick; empty before the first
  std::vector<int> tick_;      ///< lane by lane: of the trial, from 0
  LaneRows angles_, changes_;  ///< roll and pitch of the last tick, and how they changed in it
  std::vector<int> since_;     ///< leg by leg, over the lanes: ticks since its last contact
};

}  // namespace amble::controllers
