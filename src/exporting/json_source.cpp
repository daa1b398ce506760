#include "amble/exporting/json_source.hpp"

#include <array>
#include <string_view>

#include "amble/controllers/oscillators.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/problem/problem_json.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/robot/json.hpp"

namespace amble::exporting {
namespace {

using io::Json;

constexpr int export_version = 1;
constexpr std::array<std::string_view, 4> update_names{"levels", "passes", "euler", "runge_kutta"};

Json provenance_json(const Provenance& from) {
  return {{"amble", from.amble},
          {"experiment", from.experiment},
          {"seed", from.seed},
          {"generation", from.generation},
          {"index", from.index},
          {"engine", from.engine},
          {"result", from.result},
          {"settings_xxh3", from.settings_hash},
          {"genome_xxh3", from.genome_hash}};
}

Json joints_json(const ControllerTables& tables) {
  Json list = Json::array();
  for (const CommandedJoint& joint : tables.joints) {
    Json entry{{"name", joint.name}, {"driven", joint.driven}};
    entry["leg"] = joint.leg >= 0 ? Json(tables.legs[to_index(joint.leg)]) : Json(nullptr);
    if (!joint.motor) entry["motor"] = false;
    entry["command_rad"] = {joint.lower_rad, joint.upper_rad};
    list.push_back(std::move(entry));
  }
  return list;
}

/// The arrays that a controller reads, with what their numbers mean.
/// What it is told, and what follows of it.
void add_told(const ControllerTables& tables, Json& list) {
  if (tables.reads_commands())
    list.push_back({{"name", "command"},
                    {"count", 2},
                    {"order", "speed, turn"},
                    {"unit", "m/s, rad/s"},
                    {"meaning", "what it is told: speed along its forward axis, turn to the left"}});
  if (!tables.reads_heading_error()) return;
  std::string meaning =
      "how far the first yaw plus the sum of all commanded turns before this tick, times the tick, is to the "
      "left of the yaw";
  if (tables.heading_lead_rad > 0.0f)
    meaning += "; beyond heading_lead_rad to either side, the sum is changed so that it is just that";
  list.push_back(
      {{"name", "heading_error_rad"}, {"count", 1}, {"order", ""}, {"unit", "rad"}, {"meaning", meaning}});
}

Json sensors_json(const ControllerTables& tables) {
  Json list = Json::array();
  if (tables.reads_touch())
    list.push_back({{"name", "touch"},
                    {"count", tables.legs.size()},
                    {"order", "legs"},
                    {"unit", "1"},
                    {"meaning", "1 while the leg's foot touches the ground, else 0"}});
  if (tables.reads_angles())
    list.push_back(
        {{"name", "angle_rad"},
         {"count", tables.joints.size()},
         {"order", "joints"},
         {"unit", "rad"},
         {"meaning", "0 in the start pose, positive by the right-hand rule about the joint's axis"}});
  if (tables.reads_attitude())
    list.push_back({{"name", "attitude_rad"},
                    {"count", 3},
                    {"order", "roll, pitch, yaw"},
                    {"unit", "rad"},
                    {"meaning",
                     "of the root against the world (x forward, y left, z up): "
                     "R_z(yaw) R_y(pitch) R_x(roll)"}});
  if (tables.reads_speeds())
    list.push_back({{"name", "speed_rad_s"},
                    {"count", tables.joints.size()},
                    {"order", "joints"},
                    {"unit", "rad/s"},
                    {"meaning", "angle now less angle one tick ago, by the tick; 0 without a tick before"}});
  if (tables.reads_torques())
    list.push_back(
        {{"name", "torque_nm"},
         {"count", tables.joints.size()},
         {"order", "joints"},
         {"unit", "N m"},
         {"meaning", "of the motor about the joint's axis in the last step; 0 without a tick before"}});
  if (tables.reads_loads())
    list.push_back(
        {{"name", "load_n"},
         {"count", tables.legs.size()},
         {"order", "legs"},
         {"unit", "N"},
         {"meaning", "of the ground against the leg's foot, along its normal; 0 without a tick before"}});
  if (tables.reads_yaw_rate())
    list.push_back(
        {{"name", "yaw_rate_rad_s"},
         {"count", 1},
         {"order", ""},
         {"unit", "rad/s"},
         {"meaning", "yaw now less yaw one tick ago, the short way, by the tick; 0 without a tick before"}});
  add_told(tables, list);
  return list;
}

std::string sensor_name(const substrate::Sensor& sensor, const ControllerTables& tables) {
  using Kind = substrate::Sensor::Kind;
  switch (sensor.kind) {
    case Kind::angle:
      return "angle." + tables.joints[to_index(sensor.index)].name;
    case Kind::touch:
      return "touch." + tables.legs[to_index(sensor.index)];
    case Kind::roll:
      return "roll";
    case Kind::pitch:
      return "pitch";
    case Kind::yaw:
      return "yaw";
    case Kind::sine:
      return "sine";
    case Kind::speed:
      return "speed." + tables.joints[to_index(sensor.index)].name;
    case Kind::torque:
      return "torque." + tables.joints[to_index(sensor.index)].name;
    case Kind::yaw_rate:
      return "yaw_rate";
    case Kind::command_speed:
      return "command_speed";
    case Kind::command_turn:
      return "command_turn";
    case Kind::command_stop:
      return "command_stop";
    case Kind::heading_error:
      return "heading_error";
    case Kind::load:
      return "load." + tables.legs[to_index(sensor.index)];
  }
  return {};
}

Json modulation_json(const SupgTables::Modulation& modulation, const ControllerTables& tables) {
  Json json{{"parts_per_tick", controllers::parts_per_tick},
            {"starts_at_once", modulation.starts_at_once},
            {"reset_share_32768", modulation.reset_share},
            {"refractory_ticks", modulation.refractory_ticks},
            {"sensors", Json::array()},
            {"rates", modulation.rates_on ? Json(modulation.rates) : Json(nullptr)},
            {"gains_rad", modulation.shapes() ? Json(modulation.gains_rad) : Json(nullptr)}};
  if (modulation.load_feedback > 0.0f) {
    Json loads = Json::array();
    for (const controllers::LegSensor& load : modulation.loads)
      loads.push_back(
          {{"reads", sensor_name(load.sensor, tables)}, {"gain", load.gain}, {"shift", load.shift}});
    json["load_feedback"] = {
        {"strength", modulation.load_feedback}, {"loads", loads}, {"cosines", modulation.cosines}};
  }
  if (modulation.by_reading) json["reading_levels"] = controllers::reading_levels;
  for (const auto& leg : modulation.sensors) {
    Json list = Json::array();
    for (const controllers::LegSensor& sensor : leg)
      list.push_back(!sensor.is_there ? Json(nullptr)
                                      : Json{{"reads", sensor_name(sensor.sensor, tables)},
                                             {"gain", sensor.gain},
                                             {"shift", sensor.shift}});
    json["sensors"].push_back(std::move(list));
  }
  return json;
}

Json links_json(const std::vector<WeightedLink>& links) {
  Json list = Json::array();
  for (const WeightedLink& link : links) list.push_back({link.source, link.weight});
  return list;
}

Json sums_json(const std::vector<std::vector<WeightedLink>>& sums) {
  Json list = Json::array();
  for (const auto& links : sums) list.push_back(links_json(links));
  return list;
}

/// Sources are the sensors, then the neurons, then the joints listened to, in this order.
Json mixed_json(const SupgTables::Mixed& mixed, const ControllerTables& tables) {
  Json json{{"sensors", Json::array()}, {"neurons", Json::array()}, {"listened", Json::array()}};
  for (std::size_t s = 0; s < mixed.sensors.size(); ++s)
    json["sensors"].push_back({{"name", mixed.sensor_names[s]},
                               {"reads", sensor_name(mixed.sensors[s].sensor, tables)},
                               {"gain", mixed.sensors[s].gain},
                               {"shift", mixed.sensors[s].shift}});
  for (const auto& neuron : mixed.neurons)
    json["neurons"].push_back({{"name", neuron.name},
                               {"bias", neuron.bias},
                               {"step", neuron.step},
                               {"links", links_json(neuron.links)}});
  for (const auto& [joint, per_half] : mixed.listened)
    json["listened"].push_back({{"joint", joint}, {"per_half", per_half}});
  json["rates"] = sums_json(mixed.rates);
  json["amplitudes"] = sums_json(mixed.amplitudes);
  json["shifts"] = sums_json(mixed.shifts);
  json["pulls"] = sums_json(mixed.pulls);
  return json;
}

Json supg_json(const SupgTables& supg, const ControllerTables& tables) {
  Json json{{"period_ticks", supg.period_ticks},
            {"airborne_ticks_needed", supg.airborne_ticks_needed},
            {"start_tick", supg.start_tick},
            {"end_of_cycle", supg.end_of_cycle},
            {"legs", Json::array()},
            {"targets_rad", supg.targets_rad}};
  for (const SupgTables::Leg& leg : supg.legs)
    json["legs"].push_back({{"offset_ticks", leg.offset_ticks},
                            {"wait_ticks", leg.wait_ticks},
                            {"first_timer", leg.first_timer}});
  if (supg.seam)
    json["seam"] = {{"starts_at_once", supg.seam->starts_at_once},
                    {"residual_decay", supg.seam->residual_decay},
                    {"filter_share", supg.seam->filter_share},
                    {"filter_order", supg.seam->filter_order}};
  if (supg.modulation) json["modulation"] = modulation_json(*supg.modulation, tables);
  if (supg.mixed) json["mixed"] = mixed_json(*supg.mixed, tables);
  if (supg.contact)
    json["contact"] = {{"source", controllers::contact_source_names[to_index(supg.contact->source)]},
                       {"joints", supg.contact->joints},
                       {"begins", supg.contact->begins},
                       {"ends", supg.contact->ends}};
  if (!supg.limits_rad.empty()) json["limits_rad"] = supg.limits_rad;
  return json;
}

Json sensor_json(const NeuralTables::Sensor& sensor, const ControllerTables& tables) {
  Json json{{"name", sensor.name}, {"reads", sensor_name(sensor.reads, tables)}};
  if (sensor.scale != 1.0f) json["scale"] = sensor.scale;
  return json;
}

Json neural_json(const NeuralTables& neural, const ControllerTables& tables) {
  const bool is_ctrnn =
      neural.update == NeuralTables::Update::euler || neural.update == NeuralTables::Update::runge_kutta;
  Json json{{"update", update_names[to_index(neural.update)]},
            {"steps", neural.steps},
            {"slope", neural.slope},
            {"sine_period_s", neural.sine_period_s},
            {"attitude", substrate::attitude_names[to_index(neural.attitude)]}};
  if (is_ctrnn) {
    json["equation"] = neural.potential ? "potential" : "rate";
    json["cleared"] = neural.cleared;
  }
  json["sensors"] = Json::array();
  for (const NeuralTables::Sensor& sensor : neural.sensors)
    json["sensors"].push_back(sensor_json(sensor, tables));
  json["neurons"] = Json::array();
  for (const NeuralTables::Neuron& neuron : neural.neurons) {
    Json entry{{"name", neuron.name}, {"node", neuron.node}};
    if (is_ctrnn) {
      entry["bias"] = neuron.bias;
      entry["rate"] = neuron.rate;
    }
    entry["from_sensors"] = links_json(neuron.from_sensors);
    entry["from_neurons"] = links_json(neuron.from_neurons);
    json["neurons"].push_back(std::move(entry));
  }
  json["neuron_of_joint"] = neural.neuron_of_joint;
  return json;
}

/// Joints by name, in the order of their phases.
Json oscillators_json(const OscillatorTables& oscillators, const ControllerTables& tables) {
  Json json{{"swing_turns", oscillators.swing_turns},
            {"stance_turns", oscillators.stance_turns},
            {"reset", controllers::phase_reset_names[oscillators.resets ? 1 : 0]},
            {"joints", Json::array()}};
  for (const OscillatorTables::Oscillator& one : oscillators.oscillators)
    json["joints"].push_back({{"name", tables.joints[to_index(one.joint)].name},
                              {"amplitude_rad", one.amplitude_rad},
                              {"phase_turns", one.phase_turns},
                              {"offset_rad", one.offset_rad},
                              {"limits_rad", {one.lower_rad, one.upper_rad}}});
  return json;
}

Json controller_json(const ControllerTables& tables) {
  Json json{{"kind", tables.kind}, {"timestep_s", tables.timestep_s}, {"rate_hz", tables.rate_hz()},
            {"legs", tables.legs}, {"joints", joints_json(tables)},   {"sensors", sensors_json(tables)}};
  if (tables.reads_heading_error() && tables.heading_lead_rad > 0.0f)
    json["heading_lead_rad"] = tables.heading_lead_rad;
  if (const auto* const supg = std::get_if<SupgTables>(&tables.parts))
    json["supg"] = supg_json(*supg, tables);
  else if (const auto* const neural = std::get_if<NeuralTables>(&tables.parts))
    json["neural"] = neural_json(*neural, tables);
  else
    json["oscillators"] = oscillators_json(std::get<OscillatorTables>(tables.parts), tables);
  return json;
}

Json trace_json(const ControllerTables& tables, const Trace& trace) {
  Json json{{"state_names", trace.state_names}, {"ticks", Json::array()}};
  for (const Trace::Tick& tick : trace.ticks) {
    Json entry = Json::object();
    if (tables.reads_touch()) entry["touch"] = tick.touch;
    if (tables.reads_angles()) entry["angle_rad"] = tick.angle_rad;
    if (tables.reads_attitude()) entry["attitude_rad"] = tick.attitude_rad;
    if (tables.reads_speeds()) entry["speed_rad_s"] = tick.speed_rad_s;
    if (tables.reads_torques()) entry["torque_nm"] = tick.torque_nm;
    if (tables.reads_yaw_rate()) entry["yaw_rate_rad_s"] = tick.yaw_rate_rad_s;
    if (tables.reads_loads()) entry["load_n"] = tick.load_n;
    if (tables.reads_commands()) entry["command"] = tick.command;
    if (tables.reads_heading_error()) entry["heading_error_rad"] = tick.heading_error_rad;
    entry["target_rad"] = tick.target_rad;
    entry["state"] = tick.state;
    json["ticks"].push_back(std::move(entry));
  }
  return json;
}

/// Around the controller: controllers::DifferentialArchitecture.
Json differential_json(const Differential& steering) {
  Json joints = Json::array();
  for (const Differential::Steered& joint : steering.joints)
    joints.push_back({{"joint", joint.joint},
                      {"factor", joint.factor},
                      {"centre_rad", joint.centre_rad},
                      {"range_rad", {joint.lower_rad, joint.upper_rad}}});
  return {{"turn_gain", steering.turn_gain},           {"heading_gain", steering.heading_gain},
          {"full_speed_m_s", steering.full_speed_m_s}, {"most_change", steering.most_change},
          {"factors", "left, right, between, others"}, {"joints", std::move(joints)}};
}

}  // namespace

std::string json_source(const experiment::Champion& champion, const ControllerTables& tables,
                        const Provenance& provenance, const Trace& trace) {
  Json settings = experiment::problem_json(champion.problem);
  settings.erase("robot");
  Json document{
      {"provenance", provenance_json(provenance)}, {"controller", controller_json(tables)},
      {"test", trace_json(tables, trace)},         {"robot", robot::to_json(champion.problem.robot)},
      {"settings", std::move(settings)},           {"genome", neat::to_json(champion.genome)}};
  if (tables.differential) document["differential"] = differential_json(*tables.differential);
  return io::sealed_json("amble-export", export_version, document);
}

}  // namespace amble::exporting
