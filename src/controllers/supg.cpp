#include "amble/controllers/supg.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "amble/controllers/modulated_supg_batch.hpp"
#include "amble/controllers/supg_batch.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/json_file.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::controllers {

SupgParameters::SupgParameters(int legs, int types, int period_ticks)
    : legs_(legs),
      types_(types),
      period_ticks_(period_ticks),
      offset_ticks_(static_cast<std::size_t>(legs), 1),
      targets_rad_(static_cast<std::size_t>(legs * (period_ticks + 2) * types + 3)) {}

namespace {

SupgJoints joints_of(const robot::RobotSpec& robot) {
  SupgJoints joints;
  for (const robot::Leg& leg : robot.legs)
    joints.of_legs.insert(joints.of_legs.end(), leg.joints.begin(), leg.joints.end());
  for (std::size_t joint = robot.leg_joint_count(); joint < robot.joints.size(); ++joint)
    joints.others.push_back({static_cast<int>(joint), held_target_rad(robot.joints[joint])});
  joints.ranges = joint_ranges(robot);
  return joints;
}

std::vector<std::string> more_inputs(const ModulationSettings& settings) {
  if (settings.sensors.empty()) return {};
  if (settings.shape_by == ShapeBy::gain) return {std::string(sensor_input)};
  std::vector<std::string> inputs;
  for (const std::string& sensor : settings.sensors) inputs.push_back(std::string(reading_input) + sensor);
  return inputs;
}

std::vector<std::string> more_outputs(const ModulationSettings& settings) {
  if (settings.sensors.empty()) return {};
  if (settings.shape_by == ShapeBy::reading) return {std::string(rate_output)};
  return {std::string(gain_output), std::string(rate_output)};
}

/// What differs from the paper's SUPGs, as in settings.
void add_settings(const SupgSettings& settings, nlohmann::ordered_json& json) {
  nlohmann::ordered_json all = io::settings_to_json(settings);
  for (const char* const key : {"seam", "contact", "modulation"})
    if (all.contains(key)) json[key] = all[key];
}

/// The coordinates that are 0 in queries of offsets, by index.
std::vector<std::size_t> offset_zeros(const substrate::Settings& substrate) {
  std::vector<std::size_t> zeros;
  const auto offset =
      std::ranges::find(substrate.properties, offset_property, &substrate::PropertySettings::property);
  if (offset == substrate.properties.end()) return zeros;
  for (std::size_t i = 0; i < substrate.coordinates.size(); ++i)
    if (std::ranges::count(offset->zero, substrate.coordinates[i]) > 0) zeros.push_back(i);
  return zeros;
}

}  // namespace

ModulatedParameters::ModulatedParameters(SupgParameters targets, int sensors, int channels)
    : SupgParameters(std::move(targets)), modulation_(legs(), types(), period_ticks(), sensors, channels) {
  for (int leg = 0; leg < legs(); ++leg)
    for (int timer = stopped; timer <= period_ticks() + 1; ++timer)
      std::copy_n(targets_rad(leg, std::min(timer, period_ticks())), types(), modulation_.entry(leg, timer));
}

SupgArchitecture::SupgArchitecture(const SupgSettings& settings, const substrate::Settings& substrate,
                                   const robot::RobotSpec& robot, double timestep_s,
                                   const SensingSettings& sensing, std::vector<std::string> neuron_properties)
    : settings_(settings),
      timestep_s_(timestep_s),
      period_ticks_(controllers::period_ticks(settings, timestep_s)),
      joint_types_(robot.joint_types),
      joints_(joints_of(robot)),
      contact_joints_(contact_joints(settings.contact, robot)),
      leg_sensors_(leg_sensors(settings.modulation, sensing, robot, timestep_s)),
      leg_loads_(leg_loads(settings.modulation, sensing, robot, timestep_s)),
      offset_zeros_(offset_zeros(substrate)),
      layout_(substrate,
              {.kind = neuron_properties.empty() ? "supg" : "mixed",
               .network = !neuron_properties.empty(),
               .properties = {std::string(substrate::pattern_property), std::string(offset_property)},
               .neuron_properties = neuron_properties,
               .pattern_ticks = period_ticks_,
               .time = settings.seam.time,
               .more_inputs = more_inputs(settings.modulation),
               .more_outputs = more_outputs(settings.modulation)},
              robot) {
  for (const robot::Leg& leg : robot.legs) leg_names_.push_back(leg.name);
  for (int leg = 0; leg < legs(); ++leg) {
    const int first = first_driver(leg);
    for (int type = 0; type < types(); ++type) {
      const int other = driver(leg, type);
      if (other < 0 || layout_.shared(offset_property, first, other)) continue;
      const auto& nodes = layout_.nodes();
      fail_setting(
          {"controller.substrate.properties"},
          "controller.substrate.properties: \"{}\" and \"{}\" are SUPGs of leg {} but could get different "
          "offsets: name in 'zero' the coordinates that tell them apart",
          nodes[to_index(first)].name, nodes[to_index(other)].name, leg_names_[to_index(leg)]);
    }
  }
}

int SupgArchitecture::first_driver(int leg) const {
  for (int type = 0; type < types(); ++type)
    if (driver(leg, type) >= 0) return driver(leg, type);
  return -1;
}

SupgParameters SupgArchitecture::blank() const {
  SupgParameters parameters(legs(), types(), period_ticks_);
  for (int leg = 0; leg < legs(); ++leg)
    for (int timer = SupgParameters::stopped; timer <= period_ticks_; ++timer)
      for (int type = 0; type < types(); ++type)
        if (const int j = joint(leg, type); j >= 0)
          parameters.targets_rad(leg, timer)[type] = joints_.ranges[to_index(j)].at(0.5);
  return parameters;
}

SupgParameters SupgArchitecture::targets_of(const substrate::Decoded& decoded) const {
  const auto offsets = decoded.of(offset_property);
  SupgParameters parameters = blank();
  for (int leg = 0; leg < legs(); ++leg) {
    if (first_driver(leg) < 0) continue;
    const auto a = static_cast<double>(offsets[to_index(first_driver(leg))]);
    const double ticks = std::ceil((a + 1.0) * 0.5 * period_ticks_);
    parameters.set_offset_ticks(leg, static_cast<int>(std::clamp(ticks, 1.0, period_ticks_ - 1.0)));
    for (int type = 0; type < types(); ++type) {
      if (driver(leg, type) < 0) continue;
      const PatternTargets targets = pattern_targets(leg, type, decoded.patterns);
      for (int tick = 0; tick <= period_ticks_; ++tick)
        parameters.targets_rad(leg, tick)[type] = targets.at_rad(tick);
    }
  }
  return parameters;
}

SupgArchitecture::PatternTargets SupgArchitecture::pattern_targets(int leg, int type,
                                                                   const std::vector<float>& patterns) const {
  const float* const pattern =
      patterns.data() + static_cast<std::ptrdiff_t>(driver(leg, type)) * (period_ticks_ + 1);
  const double trend = settings_.seam.detrend
                           ? static_cast<double>(pattern[period_ticks_]) - static_cast<double>(pattern[0])
                           : 0.0;
  return {joints_.ranges[to_index(joint(leg, type))], pattern, period_ticks_, trend};
}

float SupgArchitecture::PatternTargets::at_rad(int tick) const {
  const double from_middle = static_cast<double>(tick) / period_ticks - 0.5;
  const double p = static_cast<double>(pattern[tick]) - from_middle * trend;
  return range.at(std::clamp((p + 1.0) * 0.5, 0.0, 1.0));
}

std::unique_ptr<Parameters> SupgArchitecture::decode(const cppn::Network& network) const {
  auto parameters = std::make_unique<SupgParameters>(targets_of(layout_.decode(network)));
  if (!modulated()) return parameters;
  auto all = std::make_unique<ModulatedParameters>(std::move(*parameters), sensors(), channels());
  add_modulation(network, *all);
  return all;
}

std::unique_ptr<Batch> SupgArchitecture::make_batch(int lanes) const {
  if (modulated())
    return std::make_unique<ModulatedSupgBatch>(supgs(lanes),
                                                ModulatedParameters(blank(), sensors(), channels()), lanes);
  return std::make_unique<SupgBatch>(make_plain_batch(lanes));
}

SupgBatch SupgArchitecture::make_plain_batch(int lanes) const {
  return {settings_, timestep_s_, leg_names_, joints_, blank(), lanes, contact(lanes)};
}

ModulatedSupgs SupgArchitecture::supgs(int lanes) const {
  return {settings_, timestep_s_, leg_names_, joints_, leg_sensors_, leg_loads_, contact(lanes)};
}

std::optional<ContactEstimate> SupgArchitecture::contact(int lanes) const {
  if (settings_.contact.source == ContactSource::touch) return std::nullopt;
  return ContactEstimate(settings_.contact, contact_joints_, timestep_s_, lanes);
}

robot::ExtraSenses SupgArchitecture::extra_senses() const {
  robot::ExtraSenses extra{.torque = settings_.contact.source == ContactSource::torque};
  for (const auto& leg : leg_sensors_)
    for (const LegSensor& sensor : leg)
      if (sensor.is_there) extra |= substrate::extra_senses(sensor.sensor);
  for (const LegSensor& load : leg_loads_) extra |= substrate::extra_senses(load.sensor);
  return extra;
}

bool SupgArchitecture::reads(const substrate::Sensor& sensor) const {
  const bool triggered = settings_.trigger == Trigger::edge || settings_.trigger == Trigger::level;
  return (triggered && tells_contact(settings_.contact.source, sensor.kind)) ||
         SupgArchitecture::scales(sensor);
}

bool SupgArchitecture::scales(const substrate::Sensor& sensor) const {
  for (const auto& leg : leg_sensors_)
    for (const LegSensor& read : leg)
      if (read.is_there && substrate::shares_rows(read.sensor, sensor)) return true;
  return std::ranges::any_of(leg_loads_, [&](const LegSensor& load) { return load.sensor == sensor; });
}

std::string SupgArchitecture::parameters_json(const Parameters& parameters) const {
  const auto* const supg = dynamic_cast<const SupgParameters*>(&parameters);
  AMBLE_CHECK(supg != nullptr, "the parameters are not a SUPG's");
  nlohmann::ordered_json json{{"kind", name()},
                              {"period_ticks", period_ticks_},
                              {"period_s", settings_.period_s},
                              {"timestep_s", timestep_s_},
                              {"trigger", trigger_names[static_cast<std::size_t>(settings_.trigger)]},
                              {"trigger_debounce_ticks", settings_.trigger_debounce_ticks},
                              {"offset", offset_names[static_cast<std::size_t>(settings_.offset)]},
                              {"start_tick", settings_.start_tick},
                              {"idle", idle_names[static_cast<std::size_t>(settings_.idle)]},
                              {"legs", leg_names_},
                              {"joint_types", joint_types_},
                              {"offset_ticks", nlohmann::ordered_json::array()},
                              {"patterns_rad", nlohmann::ordered_json::array()}};
  add_settings(settings_, json);
  for (int leg = 0; leg < legs(); ++leg) {
    json["offset_ticks"].push_back(supg->offset_ticks(leg));
    for (int type = 0; type < types(); ++type) {
      if (joint(leg, type) < 0) continue;
      auto& pattern = json["patterns_rad"].emplace_back(nlohmann::ordered_json::array());
      for (int tick = 0; tick <= period_ticks_; ++tick) pattern.push_back(supg->targets_rad(leg, tick)[type]);
    }
  }
  return json.dump();
}

}  // namespace amble::controllers
