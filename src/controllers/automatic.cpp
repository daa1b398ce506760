#include "amble/controllers/automatic.hpp"

#include <array>
#include <cmath>
#include <string>

#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

/// The authors' code has the four legs at ±1 and ±0.33, divided by 50: thirds to two decimals.
double supg_leg(int leg, int legs) {
  constexpr double divisor = 50.0;
  const double spread = legs < 2 ? 0.0 : 2.0 * leg / (legs - 1.0) - 1.0;
  // Two decimals tell up to 100 legs apart.
  return legs > 100 ? spread / divisor : std::round(spread * 100.0) / (100.0 * divisor) + 0.0;
}

/// Rows of n legs at i/(n/2): −1, −0.5, 0.5, 1 for four of them.
double network_row(int leg, int legs) {
  const int half = legs / 2;
  if (half == 0) return 0.0;
  int step = leg - half;
  if (legs % 2 == 0 && step >= 0) ++step;
  return std::round(1e4 * step / half) / 1e4 + 0.0;
}

constexpr std::array body_sensors{"pitch", "roll", "yaw", "sine"};

/// The places of the sine wave architecture's nodes.
class Planes {
 public:
  explicit Planes(const AutomaticLegs& legs)
      : legs_(legs),
        columns_(legs.types() + 1 +
                 (static_cast<int>(body_sensors.size()) + legs.count() - 1) / std::max(legs.count(), 1)) {}

  int columns() const { return columns_; }
  std::vector<double> at(int layer, int leg, int column) const {
    return {static_cast<double>(layer), network_row(leg, legs_.count()), evenly_spread(column, columns_)};
  }

 private:
  const AutomaticLegs& legs_;
  int columns_;
};

void add_network_inputs(const AutomaticLegs& legs, const Planes& planes, substrate::Settings& settings) {
  const auto add = [&](const std::string& name, const std::string& sensor, int leg, int column) {
    settings.nodes.push_back(
        {.name = name, .group = "input", .at = planes.at(-1, leg, column), .sensor = sensor, .joint = {}});
  };
  for (int leg = 0; leg < legs.count(); ++leg) {
    std::vector<LegMotor> motors = legs.motors(leg);
    const auto place = [&](const LegMotor& motor) { return legs.place_across(motor.type, true); };
    std::ranges::sort(motors, {}, place);
    for (const LegMotor& motor : motors)
      add(motor.node + " angle", "angle." + motor.joint, leg, place(motor));
    add(legs.name(leg) + ".touch", "touch." + legs.name(leg), leg, legs.types());
    for (int i = leg; i < static_cast<int>(body_sensors.size()); i += legs.count())
      add(body_sensors[to_index(i)], body_sensors[to_index(i)], leg, legs.types() + 1 + i / legs.count());
  }
}

}  // namespace

substrate::Settings automatic_supg(const robot::RobotSpec& robot) {
  const AutomaticLegs legs(robot);
  substrate::Settings settings;
  settings.coordinates = {"leg", "joint_type"};
  settings.outputs = {"pattern", "offset"};
  for (int leg = 0; leg < legs.count(); ++leg)
    for (const LegMotor& motor : legs.motors(leg))
      settings.nodes.push_back({.name = motor.node,
                                .group = "supg",
                                .at = {supg_leg(leg, legs.count()), evenly_spread(motor.type, legs.types())},
                                .sensor = {},
                                .joint = motor.joint});
  settings.properties.resize(2);
  settings.properties[0].of = settings.properties[1].of = "supg";
  settings.properties[0].property = settings.properties[0].output = substrate::pattern_property;
  // Queried with joint type 0, so that the SUPGs of a leg share it (Morse et al. 2013, sec. 3).
  settings.properties[1].property = settings.properties[1].output = offset_property;
  settings.properties[1].zero = {"joint_type"};
  return settings;
}

substrate::Settings automatic_network(const robot::RobotSpec& robot) {
  const AutomaticLegs legs(robot);
  const Planes planes(legs);
  substrate::Settings settings;
  settings.coordinates = {"layer", "row", "column"};
  settings.outputs = {"weight"};
  add_network_inputs(legs, planes, settings);
  for (int leg = 0; leg < legs.count(); ++leg)
    for (int column = 0; column < planes.columns(); ++column)
      settings.nodes.push_back({.name = legs.name(leg) + ".hidden " + std::to_string(column + 1),
                                .group = "hidden",
                                .at = planes.at(0, leg, column),
                                .sensor = {},
                                .joint = {}});
  for (int leg = 0; leg < legs.count(); ++leg)
    for (const LegMotor& motor : legs.motors_across(leg))
      settings.nodes.push_back({.name = motor.node,
                                .group = "output",
                                .at = planes.at(1, leg, legs.place_across(motor.type, legs.is_right(leg))),
                                .sensor = {},
                                .joint = motor.joint});
  settings.links.resize(2);
  settings.links[0].from = "input";
  settings.links[0].to = settings.links[1].from = "hidden";
  settings.links[1].to = "output";
  return settings;
}

}  // namespace amble::controllers
