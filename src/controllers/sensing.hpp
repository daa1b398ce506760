#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/io/settings.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/sensor.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

/// How one sensor, or each of a kind, is read.
struct SensorSettings {
  std::string of;            ///< name of the sensor, or of a kind: then all of that kind
  double scale = 1.0;        ///< what its reading is multiplied by
  double noise = 0.0;        ///< up to ± this is added, in the sensor's unit, in trials under noise alone
  double delay_s = 0.0;      ///< how old readings are, whole ticks
  double dead_time_s = 0.0;  ///< so long each reading is kept, whole ticks; 0: a new one each tick

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const SensorSettings&, const SensorSettings&) = default;
};

/// How the heading is kept that commanded turns lead to.
struct HeadingSettings {
  /// rad, 0 … 3: so far at most it is ahead of a robot that does not turn as it is told; 0: without limit
  double lead_rad = 0.0;

  void describe(io::SettingsVisitor& visitor, std::string_view lead_key = "lead_rad");
  friend bool operator==(const HeadingSettings&, const HeadingSettings&) = default;
};

/// How sensors are read; those that are not named, at once and exactly.
struct SensingSettings {
  std::vector<SensorSettings> sensors;
  HeadingSettings heading = {};

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const SensingSettings&, const SensingSettings&) = default;

  /// Whether readings differ from trial to trial.
  bool is_noisy() const;
};

/// SensorSettings of one sensor, times in ticks.
struct SensorModel {
  substrate::Sensor sensor = {};
  float scale = 1.0f;
  float noise = 0.0f;  ///< in the sensor's unit
  int delay_ticks = 0;
  int hold_ticks = 1;  ///< from one reading to the next; 1: each tick

  /// Whether anything is between the quantity and its reading.
  bool is_imperfect() const { return noise > 0.0f || delay_ticks > 0 || hold_ticks > 1; }
};

/// One per sensor that is named. Throws SettingError: an unknown name, one that is named twice, a time that
/// is not a whole number of ticks.
std::vector<SensorModel> sensor_models(const SensingSettings& settings, const robot::RobotSpec& robot,
                                       double timestep_s);

/// What a controller multiplies a reading by: 1 unless the settings have another.
float scale_of(const std::vector<SensorModel>& models, const substrate::Sensor& sensor);

/// What the sensor roll, pitch or yaw says in each lane, rad. `attitude_rad` is 3 × lanes: roll, pitch and
/// yaw of the root (robot::SensorFrame). The same bits on every CPU.
///
/// substrate::Attitude::true_angles: that angle. Attitude::misordered_quaternion: the authors' code takes its
/// angles from a quaternion (x, y, z, w) by arc tangents and an arc sine of
///   yaw: 2(xy + wz)/(w² + x² − y² − z²), pitch: 2(wy − xz), roll: 2(wx + yz)/(w² − x² − y² + z²),
/// but hands it ODE's (w, x, y, z). The three quotients then are the tangent of the roll, the sine of the
/// negative pitch, and the tangent of the negative yaw. The authors' robot looks along −x, which changes the
/// signs of roll and pitch. So the sensor roll says −yaw and the sensor yaw says −roll, both within ± π/2 as
/// an arc tangent leaves them, and the sensor pitch says the pitch.
void sense_attitude(substrate::Sensor::Kind kind, substrate::Attitude formula, const LaneArray& attitude_rad,
                    std::span<float> values_rad);

}  // namespace amble::controllers
