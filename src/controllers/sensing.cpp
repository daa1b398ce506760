#include "amble/controllers/sensing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::controllers {
namespace {

using substrate::Sensor;

/// A time in ticks. Throws SettingError unless that is a whole number.
int ticks(double time_s, double timestep_s, const std::string& key) {
  const double count = time_s / timestep_s, whole = std::round(count);
  if (std::fabs(count - whole) > 1e-9 * std::max(whole, 1.0))
    fail_setting({key, "trial.timestep_s"}, "{} = {} is {} ticks of {} s: expected a whole number", key,
                 time_s, count, timestep_s);
  return static_cast<int>(whole);
}

/// Kinds of which a robot has several.
std::string kinds_of_many() {
  std::vector<std::string_view> names;
  for (const substrate::SensorKind& kind : substrate::sensor_kinds())
    if (kind.owner == substrate::SensorOwner::joint || kind.owner == substrate::SensorOwner::leg)
      names.push_back(kind.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The sensors that a name means: one, or with a kind alone all of that kind.
std::vector<Sensor> named_sensors(const std::string& name, const robot::RobotSpec& robot,
                                  const std::string& key) {
  const auto kinds = substrate::sensor_kinds();
  const auto kind = std::ranges::find(kinds, name, &substrate::SensorKind::name);
  std::vector<Sensor> all;
  if (kind != kinds.end() && kind->owner == substrate::SensorOwner::joint)
    for (int joint = 0; joint < static_cast<int>(robot.joints.size()); ++joint)
      all.push_back({kind->kind, joint});
  else if (kind != kinds.end() && kind->owner == substrate::SensorOwner::leg)
    for (int leg = 0; leg < static_cast<int>(robot.legs.size()); ++leg) all.push_back({kind->kind, leg});
  else if (kind != kinds.end() || name.find('.') != std::string::npos)
    all.push_back(substrate::parse_sensor(name, robot, key));
  else
    fail_setting({key}, "{} = \"{}\": expected {}; for all of a kind {}", key, name,
                 substrate::expected_sensors(), kinds_of_many());
  return all;
}

constexpr int roll_row = 0, pitch_row = 1, yaw_row = 2;

/// The arc tangent of the tangent of −angle, for an angle within ± 3/2 π.
float negative_arc_tangent(float angle_rad) {
  constexpr float half_turn = 3.14159265f, quarter_turn = 1.57079633f;
  const float above = angle_rad > quarter_turn ? half_turn : 0.0f;
  const float below = angle_rad < -quarter_turn ? half_turn : 0.0f;
  return above - below - angle_rad;
}

}  // namespace

void SensorSettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("of", of,
               {"which sensor: one as in a substrate (angle.JOINT, pitch …), or all of a kind (angle, touch, "
                "load, speed, torque)"});
  visitor.number("scale", scale, {-1e6, 1e6}, {"what the controller multiplies each reading by"});
  visitor.number(
      "noise", noise, {0.0, 1e6},
      {"each reading is wrong by up to ± this, in the sensor's unit, anew each time, in trials under "
       "noise"});
  visitor.number("delay_s", delay_s, {0.0, 10.0},
                 {"a reading is that of so much earlier, s, or of the start; a whole number of ticks"});
  visitor.number("dead_time_s", dead_time_s, {0.0, 10.0},
                 {"time after each reading in which it stays as it is, s; a whole number of ticks"});
}

void HeadingSettings::describe(io::SettingsVisitor& visitor, std::string_view lead_key) {
  visitor.number(
      lead_key, lead_rad, {0.0, 3.0},
      {"so far at most the heading that commanded turns lead to is ahead of a robot that does not "
       "turn as it is told, rad; 0: without limit, so that from half a turn on the short way is to "
       "the other side"});
}

void SensingSettings::describe(io::SettingsVisitor& visitor) {
  visitor.tables("sensors", sensors, {"sensors that are not read at once and exactly"});
  visitor.table("heading", heading, {.what = "the heading of heading_error", .defaults_are_implied = true});
}

bool SensingSettings::is_noisy() const {
  return std::ranges::any_of(sensors, [](const SensorSettings& sensor) { return sensor.noise > 0.0; });
}

std::vector<SensorModel> sensor_models(const SensingSettings& settings, const robot::RobotSpec& robot,
                                       double timestep_s) {
  std::vector<SensorModel> models;
  for (std::size_t i = 0; i < settings.sensors.size(); ++i) {
    const SensorSettings& item = settings.sensors[i];
    const std::string key = fmt::format("controller.sensing.sensors[{}]", i);
    SensorModel model{.scale = static_cast<float>(item.scale),
                      .noise = static_cast<float>(item.noise),
                      .delay_ticks = ticks(item.delay_s, timestep_s, key + ".delay_s"),
                      .hold_ticks = std::max(ticks(item.dead_time_s, timestep_s, key + ".dead_time_s"), 1)};
    for (const Sensor& sensor : named_sensors(item.of, robot, key + ".of")) {
      if (sensor.kind == Sensor::Kind::sine && model.is_imperfect())
        fail_setting({key + ".of"}, "{}.of = \"sine\" is a clock, not a sensor: expected a scale alone", key);
      if (std::ranges::find(models, sensor, &SensorModel::sensor) != models.end())
        fail_setting({key + ".of"}, "{}.of = \"{}\": {} is there already", key, item.of,
                     substrate::sensor_name(sensor, robot));
      model.sensor = sensor;
      models.push_back(model);
    }
  }
  return models;
}

float scale_of(const std::vector<SensorModel>& models, const substrate::Sensor& sensor) {
  const auto found = std::ranges::find(models, sensor, &SensorModel::sensor);
  return found == models.end() ? 1.0f : found->scale;
}

void sense_attitude(substrate::Sensor::Kind kind, substrate::Attitude formula, const LaneArray& attitude_rad,
                    std::span<float> values_rad) {
  using Kind = substrate::Sensor::Kind;
  AMBLE_CHECK(kind == Kind::roll || kind == Kind::pitch || kind == Kind::yaw, "no sensor of the attitude");
  AMBLE_CHECK(attitude_rad.rows() == 3 && static_cast<std::size_t>(attitude_rad.lanes()) == values_rad.size(),
              "the attitude is 3 × lanes");
  const bool swapped = formula == substrate::Attitude::misordered_quaternion && kind != Kind::pitch;
  const int own_row = kind == Kind::roll ? roll_row : kind == Kind::pitch ? pitch_row : yaw_row;
  if (!swapped) {
    std::copy_n(attitude_rad.row(own_row), values_rad.size(), values_rad.begin());
    return;
  }
  const float* const other_rad = attitude_rad.row(kind == Kind::roll ? yaw_row : roll_row);
  for (std::size_t lane = 0; lane < values_rad.size(); ++lane)
    values_rad[lane] = negative_arc_tangent(other_rad[lane]);
}

}  // namespace amble::controllers
