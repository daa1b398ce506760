#pragma once

#include <string>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/sensor.hpp"

namespace amble::controllers {

/// How one sensor, or each of a kind, is read.
struct SensorSettings {
  std::string of;
  double scale = 1.0;
  double noise = 0.0;
  double delay_s = 0.0;
  double dead_time_s = 0.0;

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const SensorSettings&, const SensorSettings&) = default;
};

/// How sensors are read; those that are not named, at once and exactly.
struct SensingSettings {
  std::vector<SensorSettings> sensors;

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

}  // namespace amble::controllers
