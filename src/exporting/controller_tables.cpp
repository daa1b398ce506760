#include "amble/exporting/controller_tables.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/differential.hpp"
#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/network.hpp"
#include "amble/controllers/oscillators.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/controllers/wiring.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/exporting/mixed_tables.hpp"

namespace amble::exporting {
namespace {

using controllers::SupgParameters;
using experiment::Problem;

std::vector<CommandedJoint> commanded_joints(const robot::RobotSpec& robot) {
  std::vector<CommandedJoint> joints;
  for (const robot::Joint& joint : robot.joints) {
    const robot::AngleRange range = joint.command_range();
    joints.push_back({joint.name, -1, range.lower_rad, range.upper_rad, joint.driven(), joint.has_motor()});
  }
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    for (const int joint : robot.legs[leg].joints)
      if (joint >= 0) joints[to_index(joint)].leg = static_cast<int>(leg);
  return joints;
}

/// Throws UserError for triggers that no exported controller has.
int airborne_ticks_needed(const controllers::SupgSettings& settings, const controllers::CycleRule& rule) {
  if (settings.trigger == controllers::Trigger::random)
    fail(ExitCode::bad_input,
         "controller.supg.trigger = \"random\" cannot be exported: it is a control for simulations; expected "
         "\"edge\", \"level\" or \"none\"");
  return rule.by_touch ? rule.airborne_ticks_needed : SupgTables::never;
}

SupgTables::Seam seam_of(const Problem& problem) {
  const controllers::SupgSettings& settings = problem.controller.supg;
  const controllers::SeamFactors factors(settings.seam, problem.trial.timestep_s);
  SupgTables::Seam seam{.starts_at_once = settings.offset == controllers::Offset::phase,
                        .residual_decay = factors.residual_decay,
                        .filter_share = factors.filter_share,
                        .filter_order = factors.filter_order};
  return seam;
}

SupgTables::Modulation modulation_of(const Problem& problem,
                                     const controllers::ModulatedParameters& parameters) {
  const controllers::ModulationSettings& settings = problem.controller.supg.modulation;
  const controllers::Modulation& from = parameters.modulation();
  SupgTables::Modulation modulation{
      .starts_at_once = problem.controller.supg.offset == controllers::Offset::phase,
      .rates_on = settings.rate > 0.0 && from.sensors() > 0,
      .reset_share = controllers::reset_share(settings),
      .refractory_ticks = settings.refractory_ticks,
      .sensors = controllers::leg_sensors(settings, problem.controller.sensing, problem.robot,
                                          problem.trial.timestep_s),
      .rates = {},
      .load_feedback = static_cast<float>(settings.load_feedback),
      .loads = controllers::leg_loads(settings, problem.controller.sensing, problem.robot,
                                      problem.trial.timestep_s),
      .cosines = controllers::phase_cosines(settings, parameters.period_ticks()),
      .by_reading = settings.shape_by == controllers::ShapeBy::reading,
      .gains_rad = {}};
  for (int leg = 0; leg < parameters.legs(); ++leg) {
    std::vector<float>& rates = modulation.rates.emplace_back();
    for (int s = 0; s < from.sensors(); ++s) rates.push_back(from.rate(leg, s));
  }
  if (settings.shape <= 0.0) return modulation;
  const std::vector<std::vector<float>> none(problem.robot.joints.size());
  modulation.gains_rad.assign(to_index(from.channels()), none);
  for (int leg = 0; leg < parameters.legs(); ++leg) {
    const auto& joints = problem.robot.legs[to_index(leg)].joints;
    for (std::size_t type = 0; type < joints.size(); ++type)
      for (int channel = 0; channel < from.channels() && joints[type] >= 0; ++channel)
        for (int timer = -1; timer <= parameters.period_ticks() + 1; ++timer)
          modulation.gains_rad[to_index(channel)][to_index(joints[type])].push_back(
              from.entry(leg, timer)[to_index((1 + channel) * from.width()) + type]);
  }
  return modulation;
}

SupgTables::Contact contact_of(const Problem& problem) {
  const controllers::ContactSettings& settings = problem.controller.supg.contact;
  return {
      .source = settings.source,
      .joints = controllers::contact_joints(settings, problem.robot),
      .begins = static_cast<float>(settings.threshold),
      .ends = static_cast<float>(settings.release * settings.threshold),
      .per_tick_squared = static_cast<float>(1.0 / (problem.trial.timestep_s * problem.trial.timestep_s))};
}

/// The values of the timers are those of controllers::SupgBatch::load.
SupgTables supg_tables(const Problem& problem, const SupgParameters& parameters) {
  const controllers::SupgSettings& settings = problem.controller.supg;
  const int period = parameters.period_ticks();
  const controllers::CycleRule rule = controllers::cycle_rule(settings, period);
  SupgTables tables{.period_ticks = period,
                    .airborne_ticks_needed = airborne_ticks_needed(settings, rule),
                    .start_tick = settings.start_tick,
                    .end_of_cycle = rule.end,
                    .legs = {},
                    .targets_rad = std::vector<std::vector<float>>(problem.robot.joints.size())};
  if (settings.contact.source != controllers::ContactSource::touch && tables.is_triggered())
    tables.contact = contact_of(problem);
  if (settings.seam.smooths()) tables.seam = seam_of(problem);
  if (const auto* const modulated = dynamic_cast<const controllers::ModulatedParameters*>(&parameters))
    tables.modulation = modulation_of(problem, *modulated);
  if (tables.seam || tables.modulation)
    for (const controllers::JointRange& range : controllers::joint_ranges(problem.robot))
      tables.limits_rad.push_back({range.at(0.0), range.at(1.0)});
  for (int leg = 0; leg < parameters.legs(); ++leg) {
    const int offset = parameters.offset_ticks(leg);
    const bool phase = settings.offset == controllers::Offset::phase;
    const int after_offset = offset + 1 >= period ? tables.end_of_cycle : offset + 1;
    tables.legs.push_back({.offset_ticks = offset,
                           .wait_ticks = phase ? 0 : offset,
                           .first_timer = phase ? after_offset : settings.start_tick});
    const auto& joints = problem.robot.legs[to_index(leg)].joints;
    for (std::size_t type = 0; type < joints.size(); ++type) {
      if (joints[type] < 0) continue;
      const int last = tables.modulation ? period + 1
                       : tables.seam     ? period
                                         : std::max(period - 1, tables.end_of_cycle);
      for (int timer = SupgParameters::stopped; timer <= last; ++timer)
        tables.targets_rad[to_index(joints[type])].push_back(
            parameters.targets_rad(leg, std::min(timer, period))[type]);
    }
  }
  for (std::size_t j = problem.robot.leg_joint_count(); j < problem.robot.joints.size(); ++j)
    tables.targets_rad[j] = {controllers::held_target_rad(problem.robot.joints[j])};
  return tables;
}

/// Joints in the order of controllers::OscillatorArchitecture: leg by leg.
OscillatorTables oscillator_tables(const Problem& problem, const controllers::OscillatorParameters& walker) {
  OscillatorTables tables{.swing_turns = walker.swing_turns,
                          .stance_turns = walker.stance_turns,
                          .resets = problem.controller.oscillators.reset == controllers::PhaseReset::touch};
  const std::vector<controllers::JointRange> ranges = controllers::joint_ranges(problem.robot);
  for (const robot::Leg& leg : problem.robot.legs)
    for (const int joint : leg.joints) {
      if (joint < 0) continue;
      const std::size_t i = tables.oscillators.size();
      const controllers::JointRange& range = ranges[to_index(joint)];
      tables.oscillators.push_back({.joint = joint,
                                    .amplitude_rad = walker.amplitude_rad[i],
                                    .phase_turns = walker.phase_turns[i],
                                    .offset_rad = walker.offset_rad[i],
                                    .lower_rad = static_cast<float>(range.lower_rad),
                                    .upper_rad = static_cast<float>(range.upper_rad)});
    }
  return tables;
}

/// Links of weight 0 are left out; they change no sum (docs/CONTROLLERS.md).
void add_links(const controllers::Wiring& wiring, const controllers::Wiring::Neuron& from,
               const std::vector<float>& weights, NeuralTables::Neuron& neuron) {
  for (int k = from.first_link; k < from.first_link + from.link_count; ++k) {
    const auto& link = wiring.links[to_index(k)];
    const float weight = weights[to_index(link.index)];
    if (weight == 0.0f) continue;
    const int neuron_source = link.source_slot - wiring.sensor_count();
    if (neuron_source < 0)
      neuron.from_sensors.push_back({link.source_slot, weight});
    else
      neuron.from_neurons.push_back({neuron_source, weight});
  }
}

NeuralTables neural_tables(const Problem& problem, const controllers::NeuralArchitecture& architecture,
                           const controllers::NeuralParameters& parameters) {
  const substrate::Layout& layout = architecture.layout();
  const controllers::Wiring wiring = controllers::make_wiring(layout);
  NeuralTables tables;
  tables.sine_period_s = problem.controller.substrate.sine_period_s;
  tables.attitude = problem.controller.substrate.attitude;
  const auto models =
      controllers::sensor_models(problem.controller.sensing, problem.robot, problem.trial.timestep_s);
  for (const substrate::Node& node : layout.nodes())
    if (node.sensor)
      tables.sensors.push_back({node.name, *node.sensor, controllers::scale_of(models, *node.sensor)});
  const bool is_ctrnn = !parameters.rates.empty();
  for (std::size_t n = 0; n < wiring.neurons.size(); ++n) {
    const int node = wiring.neurons[n].node;
    NeuralTables::Neuron neuron{.name = layout.nodes()[to_index(node)].name, .node = node};
    if (is_ctrnn) {
      neuron.bias = parameters.decoded.of(controllers::bias_property)[to_index(node)];
      neuron.rate = parameters.rates[n];
    }
    add_links(wiring, wiring.neurons[n], parameters.decoded.weights, neuron);
    tables.neurons.push_back(std::move(neuron));
  }
  for (const int slot : wiring.joint_slots) {
    AMBLE_CHECK(slot < 0 || slot >= wiring.sensor_count(), "no sensor drives a joint");
    tables.neuron_of_joint.push_back(slot < 0 ? -1 : slot - wiring.sensor_count());
  }
  return tables;
}

NeuralTables network_tables(const Problem& problem, const controllers::NetworkArchitecture& architecture,
                            const controllers::NeuralParameters& parameters) {
  NeuralTables tables = neural_tables(problem, architecture, parameters);
  const controllers::NetworkSettings& settings = problem.controller.network;
  const controllers::Wiring wiring = controllers::make_wiring(architecture.layout());
  const bool by_level = !wiring.cyclic && wiring.depth() <= settings.passes;
  tables.update = by_level ? NeuralTables::Update::levels : NeuralTables::Update::passes;
  tables.steps = by_level ? 1 : settings.passes;
  tables.slope = static_cast<float>(settings.slope);
  return tables;
}

NeuralTables ctrnn_tables(const Problem& problem, const controllers::CtrnnArchitecture& architecture,
                          const controllers::NeuralParameters& parameters) {
  NeuralTables tables = neural_tables(problem, architecture, parameters);
  const controllers::CtrnnSettings& settings = problem.controller.ctrnn;
  tables.update = settings.integrator == controllers::Integrator::rk4 ? NeuralTables::Update::runge_kutta
                                                                      : NeuralTables::Update::euler;
  tables.steps = settings.steps_per_tick;
  tables.potential = settings.equation == controllers::Equation::potential;
  tables.cleared = settings.state == controllers::StateRule::cleared;
  tables.slope = static_cast<float>(settings.slope);
  return tables;
}

/// The sensor that a guess of contacts reads.
substrate::Sensor::Kind read_by(const SupgTables::Contact& contact) {
  using controllers::ContactSource;
  using Kind = substrate::Sensor::Kind;
  if (contact.source == ContactSource::tracking) return Kind::angle;
  return contact.source == ContactSource::shock ? Kind::roll : Kind::torque;
}

bool reads(const ControllerTables& tables, auto wanted) {
  if (const auto* const supg = std::get_if<SupgTables>(&tables.parts)) {
    if (supg->contact && wanted(read_by(*supg->contact))) return true;
    if (supg->mixed && std::ranges::any_of(supg->mixed->sensors, [&](const controllers::LegSensor& sensor) {
          return wanted(sensor.sensor.kind);
        }))
      return true;
    if (!supg->modulation) return false;
    if (supg->modulation->load_feedback > 0.0f && wanted(substrate::Sensor::Kind::load)) return true;
    return std::ranges::any_of(supg->modulation->sensors, [&](const auto& leg) {
      return std::ranges::any_of(leg, [&](const controllers::LegSensor& sensor) {
        return sensor.is_there && wanted(sensor.sensor.kind);
      });
    });
  }
  const auto* const neural = std::get_if<NeuralTables>(&tables.parts);
  return neural != nullptr && std::ranges::any_of(neural->sensors, [&](const NeuralTables::Sensor& sensor) {
           return wanted(sensor.reads.kind);
         });
}

Differential differential_tables(const controllers::DifferentialArchitecture& steered) {
  const controllers::DifferentialSettings& settings = steered.settings();
  Differential tables{.turn_gain = static_cast<float>(settings.turn_gain),
                      .heading_gain = static_cast<float>(settings.heading_gain),
                      .full_speed_m_s = static_cast<float>(settings.full_speed_m_s),
                      .most_change = steered.most_change()};
  for (const auto& joint : steered.joints())
    tables.joints.push_back({.joint = joint.joint,
                             .factor = joint.factor,
                             .centre_rad = joint.centre_rad,
                             .lower_rad = joint.lower_rad,
                             .upper_rad = joint.upper_rad});
  return tables;
}

/// Joints of no leg stay where they are.
void hold_other_joints(const robot::RobotSpec& robot, ControllerTables& tables) {
  for (std::size_t j = robot.leg_joint_count(); j < tables.joints.size(); ++j)
    tables.joints[j].lower_rad = tables.joints[j].upper_rad = controllers::held_target_rad(robot.joints[j]);
}

}  // namespace

bool ControllerTables::reads_angles() const {
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::angle; });
}

bool ControllerTables::reads_touch() const {
  const auto* const supg = std::get_if<SupgTables>(&parts);
  if (supg != nullptr && supg->is_triggered() && !supg->contact) return true;
  const auto* const oscillators = std::get_if<OscillatorTables>(&parts);
  if (oscillators != nullptr) return oscillators->resets;
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::touch; });
}

bool ControllerTables::reads_attitude() const {
  using Kind = substrate::Sensor::Kind;
  return reads_heading_error() || reads(*this, [](auto sensed) {
           return sensed == Kind::roll || sensed == Kind::pitch || sensed == Kind::yaw;
         });
}

bool ControllerTables::reads_speeds() const {
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::speed; });
}

bool ControllerTables::reads_torques() const {
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::torque; });
}

bool ControllerTables::reads_yaw_rate() const {
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::yaw_rate; });
}

bool ControllerTables::reads_loads() const {
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::load; });
}

bool ControllerTables::reads_commands() const {
  using Kind = substrate::Sensor::Kind;
  return differential || reads(*this, [](auto sensed) {
           return sensed == Kind::command_speed || sensed == Kind::command_turn ||
                  sensed == Kind::command_stop || sensed == Kind::heading_error;
         });
}

bool ControllerTables::reads_heading_error() const {
  if (differential && differential->heading_gain > 0.0f) return true;
  return reads(*this, [](auto sensed) { return sensed == substrate::Sensor::Kind::heading_error; });
}

bool ControllerTables::reads_nothing() const {
  return !reads_touch() && !reads_angles() && !reads_attitude() && !reads_speeds() && !reads_torques() &&
         !reads_yaw_rate() && !reads_loads();
}

ControllerTables controller_tables(const Problem& problem, const neat::Genome& genome) {
  const auto* const steered =
      dynamic_cast<const controllers::DifferentialArchitecture*>(problem.architecture.get());
  const controllers::Architecture& architecture =
      steered != nullptr ? steered->walker() : *problem.architecture;
  if (problem.controller.switching.any())
    fail(ExitCode::bad_input,
         "controller.switching cannot be exported; expected a champion of one genome, as `amble repertoire "
         "RUN --cell` writes");
  const auto parameters = problem.decode(genome);
  ControllerTables tables{
      .kind = architecture.name(),
      .timestep_s = problem.trial.timestep_s,
      .joints = commanded_joints(problem.robot),
      .legs = {},
      .parts = {},
      .heading_lead_rad = static_cast<float>(problem.controller.sensing.heading.lead_rad)};
  for (const robot::Leg& leg : problem.robot.legs) tables.legs.push_back(leg.name);
  const auto* const neural = dynamic_cast<const controllers::NeuralParameters*>(parameters.get());
  if (const auto* const supg = dynamic_cast<const SupgParameters*>(parameters.get())) {
    SupgTables parts = supg_tables(problem, *supg);
    const auto* const mixed = dynamic_cast<const controllers::MixedArchitecture*>(&architecture);
    if (mixed != nullptr)
      parts.mixed =
          mixed_tables(*mixed, dynamic_cast<const controllers::MixedParameters&>(*supg), problem.robot);
    tables.parts = std::move(parts);
    hold_other_joints(problem.robot, tables);
  } else if (const auto* network = dynamic_cast<const controllers::NetworkArchitecture*>(&architecture)) {
    tables.parts = network_tables(problem, *network, *neural);
  } else if (const auto* ctrnn = dynamic_cast<const controllers::CtrnnArchitecture*>(&architecture)) {
    tables.parts = ctrnn_tables(problem, *ctrnn, *neural);
  } else if (const auto* walker = dynamic_cast<const controllers::OscillatorParameters*>(parameters.get())) {
    tables.parts = oscillator_tables(problem, *walker);
    hold_other_joints(problem.robot, tables);
  } else {
    fail(ExitCode::bad_input,
         "a controller of kind {} cannot be exported: expected supg, mixed, network, ctrnn or oscillators",
         architecture.name());
  }
  if (steered != nullptr) tables.differential = differential_tables(*steered);
  return tables;
}

}  // namespace amble::exporting
