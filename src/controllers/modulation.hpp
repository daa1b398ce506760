#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/sensing.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/cppn/network.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::controllers {

/// CPPN input and outputs that modulated SUPGs have beside the others. With ShapeBy::reading each sensor has
/// an input of its own, such as sensed.pitch.
inline constexpr std::string_view sensor_input = "sensor", reading_input = "sensed.";
inline constexpr std::string_view gain_output = "gain", rate_output = "rate";

/// How a leg senses: s = reading × gain − shift, limited to ± 1, so that about ± 1 is the whole range.
struct LegSensor {
  bool is_there = false;  ///< a leg without a joint of that type senses 0
  substrate::Sensor sensor = {};
  float gain = 1.0f, shift = 0.0f;

  /// What a reading says, from −1 to 1; −1 for one that is not a number.
  float sensed(float reading) const {
    const float s = reading * gain - shift, above = s > -1.0f ? s : -1.0f;
    return above < 1.0f ? above : 1.0f;
  }
};

/// One that the robot has.
LegSensor scaled_sensor(const substrate::Sensor& sensor, const robot::RobotSpec& robot,
                        const std::vector<SensorModel>& models);

/// Leg by leg, sensor by sensor of the settings. Throws SettingError for one that there is not.
std::vector<std::vector<LegSensor>> leg_sensors(const ModulationSettings& settings,
                                                const SensingSettings& sensing, const robot::RobotSpec& robot,
                                                double timestep_s);

/// The load of each leg's foot as a share of the robot's weight; none without load_feedback.
std::vector<LegSensor> leg_loads(const ModulationSettings& settings, const SensingSettings& sensing,
                                 const robot::RobotSpec& robot, double timestep_s);

/// cos 2πφ by a timer's whole ticks, 0 … period_ticks; none without load_feedback.
std::vector<float> phase_cosines(const ModulationSettings& settings, int period_ticks);

/// The readings at which ShapeBy::reading has patterns; at 0 it is the pattern itself.
inline constexpr std::array<float, 4> reading_levels{-1.0f, -0.5f, 0.5f, 1.0f};

/// How much of the pattern at a level a reading s takes: 1 there, and linearly less, to 0 half a unit away.
inline float weight_of_level(float s, float level) {
  const float away = (s + s) - (level + level), near = 1.0f - (away < 0.0f ? -away : away);
  return near > 0.0f ? near : 0.0f;
}

/// What shifts targets has so many channels: sensors, or their levels, sensor by sensor.
int shape_channels(const ModulationSettings& settings);

/// What a CPPN says of how sensors modulate each leg.
class Modulation {
 public:
  Modulation(int legs, int types, int period_ticks, int sensors, int channels);

  /// In front of the pattern's first entry, timer −1, and behind the last, timer `period`, is one more, so
  /// that there is always a next.
  int entries() const { return period_ticks_ + 3; }
  int sensors() const { return sensors_; }
  int channels() const { return channels_; }
  /// Types, in multiples of four.
  int width() const { return width_; }
  /// Floats from one entry to the next, a power of two: groups of width() numbers, type by type; first the
  /// targets (rad), then channel by channel what it shifts them by where it says 1 (rad).
  std::size_t stride() const { return std::size_t{1} << stride_bits_; }
  int stride_bits() const { return stride_bits_; }
  float* entry(int leg, int timer) { return values_.data() + index(leg, timer); }
  const float* entry(int leg, int timer) const { return values_.data() + index(leg, timer); }
  /// ρ where the sensor says 1.
  float& rate(int leg, int sensor) { return rates_[static_cast<std::size_t>(leg * sensors_ + sensor)]; }
  float rate(int leg, int sensor) const { return rates_[static_cast<std::size_t>(leg * sensors_ + sensor)]; }

 private:
  std::size_t index(int leg, int timer) const {
    return static_cast<std::size_t>(leg * entries() + timer + 1) * stride();
  }

  int period_ticks_, sensors_, channels_, width_, stride_bits_;
  LaneRows values_;  ///< one row, which begins on a cache line
  std::vector<float> rates_;
};

/// Timers of modulated SUPGs count in parts of a tick, so that they add up exactly.
inline constexpr int parts_bits = 14;
inline constexpr std::int32_t parts_per_tick = 1 << parts_bits;

/// The series of 2^x to the seventh power, the highest first: an error of 1e−6 at ± 1, a twentieth of a part.
inline constexpr std::array<float, 8> power_of_two_series{
    1.52527338e-05f, 0.000154035304f, 0.00133335581f, 0.00961812911f,
    0.0555041087f,   0.240226507f,    0.693147181f,   1.0f};

/// By how many parts a timer advances in a tick: parts_per_tick × 2^rho, rounded; `rho` within ± 1. Exact for
/// −1, 0 and 1. Single precision, each operation rounded.
inline std::int32_t advance_parts(float rho) {
  float power = power_of_two_series[0];
  for (std::size_t i = 1; i < power_of_two_series.size(); ++i) power = power * rho + power_of_two_series[i];
  const float and_a_half = power * static_cast<float>(parts_per_tick) + 0.5f;
  return static_cast<std::int32_t>(and_a_half);
}

/// An advance, less `pull` × `cosine` ticks, from 0 to two ticks. Single precision, each operation rounded.
inline std::int32_t held_advance(std::int32_t advance, float pull, float cosine) {
  const float ticks = pull * cosine, parts = ticks * static_cast<float>(parts_per_tick);
  const std::int32_t left = advance - static_cast<std::int32_t>(parts);
  return left < 0 ? 0 : left > 2 * parts_per_tick ? 2 * parts_per_tick : left;
}

/// Where a trigger takes a timer, in parts: by `share` / 2^15 of the shorter way round to `start`. A timer
/// that stands (−1) starts unless `share` is 0.
std::int32_t reset_timer(std::int32_t timer, std::int32_t start, std::int32_t period, std::int32_t share);
std::int32_t reset_share(const ModulationSettings& settings);

}  // namespace amble::controllers
