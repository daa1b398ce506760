#include "amble/controllers/modulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "amble/controllers/joint_type.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

using substrate::Sensor;
using substrate::SensorKind;
using substrate::SensorOwner;

std::string expected_sensors() {
  std::string text;
  for (const SensorKind& kind : substrate::sensor_kinds()) {
    if (kind.owner == SensorOwner::clock) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", kind.name,
                        kind.owner == SensorOwner::joint ? ".TYPE" : "");
  }
  return text;
}

/// The joint of a leg that a name such as angle.knee means; nothing where the leg lacks it.
std::optional<int> joint_of(const robot::RobotSpec& robot, std::size_t leg, std::string_view type,
                            const std::string& key, const std::string& name) {
  const int joint = robot.legs[leg].joints[joint_type_index(robot, type, key, name)];
  return joint < 0 ? std::nullopt : std::optional(joint);
}

/// Scales a reading to about ± 1.
void set_scale(const SensorKind& kind, const robot::RobotSpec& robot, double scale, LegSensor& sensor) {
  double full = kind.full, middle = 0.0;
  if (kind.kind == Sensor::Kind::angle) {
    const robot::AngleRange range = robot.joints[to_index(sensor.sensor.index)].command_range();
    full = 0.5 * (range.upper_rad - range.lower_rad);
    middle = 0.5 * (range.upper_rad + range.lower_rad);
  }
  if (kind.kind == Sensor::Kind::torque)
    full = robot.joints[to_index(sensor.sensor.index)].servo.max_torque_nm;
  if (kind.kind == Sensor::Kind::load) full = robot.total_mass_kg() * norm(robot.gravity_m_s2);
  if (!(full > 0.0 && std::isfinite(full))) full = 1.0;
  sensor.gain = static_cast<float>(scale / full);
  sensor.shift = static_cast<float>(middle * scale / full);
}

LegSensor leg_sensor(const std::string& name, std::size_t leg, const robot::RobotSpec& robot,
                     const std::vector<SensorModel>& models, const std::string& key) {
  const std::size_t dot = name.find('.');
  const auto kinds = substrate::sensor_kinds();
  const auto kind = std::ranges::find(kinds, std::string_view(name).substr(0, dot), &SensorKind::name);
  const bool typed = kind != kinds.end() && kind->owner == SensorOwner::joint;
  if (kind == kinds.end() || kind->owner == SensorOwner::clock || typed != (dot != std::string::npos))
    fail_setting({key}, "{} = \"{}\": expected {}", key, name, expected_sensors());
  LegSensor sensor{.is_there = true, .sensor = {kind->kind, 0}};
  if (kind->owner == SensorOwner::leg) sensor.sensor.index = static_cast<int>(leg);
  if (typed) {
    const auto joint = joint_of(robot, leg, std::string_view(name).substr(dot + 1), key, name);
    if (!joint) return {};
    sensor.sensor.index = *joint;
  }
  return scaled_sensor(sensor.sensor, robot, models);
}

}  // namespace

LegSensor scaled_sensor(const substrate::Sensor& sensor, const robot::RobotSpec& robot,
                        const std::vector<SensorModel>& models) {
  LegSensor scaled{.is_there = true, .sensor = sensor};
  set_scale(substrate::kind_of(sensor), robot, static_cast<double>(scale_of(models, sensor)), scaled);
  return scaled;
}

std::vector<std::vector<LegSensor>> leg_sensors(const ModulationSettings& settings,
                                                const SensingSettings& sensing, const robot::RobotSpec& robot,
                                                double timestep_s) {
  const std::vector<SensorModel> models = sensor_models(sensing, robot, timestep_s);
  std::vector<std::vector<LegSensor>> sensors(robot.legs.size());
  for (std::size_t i = 0; i < settings.sensors.size(); ++i) {
    const std::string key = fmt::format("controller.supg.modulation.sensors[{}]", i);
    const auto end = settings.sensors.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(settings.sensors.begin(), end, settings.sensors[i]) != end)
      fail_setting({key}, "{} = \"{}\" is there twice", key, settings.sensors[i]);
    for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
      sensors[leg].push_back(leg_sensor(settings.sensors[i], leg, robot, models, key));
  }
  return sensors;
}

std::vector<LegSensor> leg_loads(const ModulationSettings& settings, const SensingSettings& sensing,
                                 const robot::RobotSpec& robot, double timestep_s) {
  if (settings.load_feedback <= 0.0) return {};
  const std::vector<SensorModel> models = sensor_models(sensing, robot, timestep_s);
  std::vector<LegSensor> loads;
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    loads.push_back(scaled_sensor({Sensor::Kind::load, static_cast<int>(leg)}, robot, models));
  return loads;
}

std::vector<float> phase_cosines(const ModulationSettings& settings, int period_ticks) {
  std::vector<float> cosines;
  if (settings.load_feedback <= 0.0) return cosines;
  for (int tick = 0; tick <= period_ticks; ++tick)
    cosines.push_back(static_cast<float>(std::cos(2.0 * std::numbers::pi * tick / period_ticks)));
  return cosines;
}

int shape_channels(const ModulationSettings& settings) {
  const auto sensors = static_cast<int>(settings.sensors.size());
  return settings.shape_by == ShapeBy::reading ? sensors * static_cast<int>(reading_levels.size()) : sensors;
}

Modulation::Modulation(int legs, int types, int period_ticks, int sensors, int channels)
    : period_ticks_(period_ticks),
      sensors_(sensors),
      channels_(channels),
      width_((types + 3) / 4 * 4),
      stride_bits_(static_cast<int>(std::bit_width(static_cast<unsigned>((1 + channels) * width_ - 1)))),
      values_(1, legs * (period_ticks + 3) << stride_bits_),
      rates_(to_index(legs * sensors)) {}

std::int32_t reset_timer(std::int32_t timer, std::int32_t start, std::int32_t period, std::int32_t share) {
  if (share == 0) return timer;
  if (timer < 0) return start;
  std::int32_t way = start - timer;
  if (2 * static_cast<std::int64_t>(way) <= -period) way += period;
  const std::int32_t next = timer + static_cast<std::int32_t>(static_cast<std::int64_t>(way) * share / 32768);
  return next >= period ? next - period : next;
}

std::int32_t reset_share(const ModulationSettings& settings) {
  return static_cast<std::int32_t>(std::lround(settings.reset * 32768.0));
}

}  // namespace amble::controllers
