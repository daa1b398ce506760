#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "amble/controllers/supg.hpp"
#include "amble/core/index.hpp"

/// What a CPPN says of how sensors modulate SUPGs.
namespace amble::controllers {
namespace {

/// An output of a CPPN at some points, within ± 1.
std::vector<double> answers(const cppn::Network& network, const cppn::Points& points, int output,
                            int outputs) {
  std::vector<float> results(to_index(outputs * points.capacity()));
  network.evaluate(points, results);
  std::vector<double> said;
  said.reserve(to_index(points.count()));
  for (int point = 0; point < points.count(); ++point)
    said.push_back(
        std::clamp(static_cast<double>(results[to_index(output * points.capacity() + point)]), -1.0, 1.0));
  return said;
}

/// Entries go on by one behind the period, with the same numbers.
void repeat_last(Modulation& modulation, int leg, int group, int period_ticks) {
  modulation.entry(leg, period_ticks + 1)[group] = modulation.entry(leg, period_ticks)[group];
}

}  // namespace

void SupgArchitecture::add_modulation(const cppn::Network& network, ModulatedParameters& parameters) const {
  if (sensors() == 0) return;
  add_rates(network, parameters);
  if (settings_.modulation.shape_by == ShapeBy::gain)
    add_gains(network, parameters);
  else
    add_readings(network, parameters);
}

/// The CPPN's inputs for a node and a sensor, at time 0.
std::vector<float> SupgArchitecture::query_inputs(int node, int sensor) const {
  const auto& at = layout_.nodes()[to_index(node)].at;
  std::vector<float> inputs(at.begin(), at.end());
  inputs.resize(layout_.input_names().size());
  if (settings_.modulation.shape_by == ShapeBy::gain)
    inputs.back() = static_cast<float>((sensor + 1.0) / sensors());
  else
    inputs[inputs.size() - to_index(sensors() - sensor)] = 1.0f;
  return inputs;
}

void SupgArchitecture::add_rates(const cppn::Network& network, ModulatedParameters& parameters) const {
  substrate::QueryPoints queries;
  std::vector<std::pair<float*, int>> rates;  // and the point that says it
  for (int sensor = 0; sensor < sensors(); ++sensor)
    for (int leg = 0; leg < legs(); ++leg) {
      if (first_driver(leg) < 0) continue;
      std::vector<float> inputs = query_inputs(first_driver(leg), sensor);
      for (const std::size_t zero : offset_zeros_) inputs[zero] = 0.0f;
      rates.emplace_back(&parameters.modulation().rate(leg, sensor), queries.add(inputs));
    }
  const int outputs = static_cast<int>(layout_.output_names().size());
  const auto said =
      answers(network, queries.points(static_cast<int>(layout_.input_names().size())), outputs - 1, outputs);
  for (const auto& [rate, point] : rates)
    *rate = static_cast<float>(settings_.modulation.rate * said[to_index(point)]);
}

void SupgArchitecture::add_gains(const cppn::Network& network, ModulatedParameters& parameters) const {
  const std::size_t coordinates = layout_.coordinates().size(), all = layout_.input_names().size();
  substrate::QueryPoints queries;
  struct Gain {
    int leg, type, sensor, tick, point;
  };
  std::vector<Gain> gains;
  for (int sensor = 0; sensor < sensors(); ++sensor)
    for (int leg = 0; leg < legs(); ++leg)
      for (int type = 0; type < types(); ++type) {
        if (driver(leg, type) < 0) continue;
        std::vector<float> inputs = query_inputs(driver(leg, type), sensor);
        for (int tick = 0; tick <= period_ticks_; ++tick) {
          substrate::set_time_inputs(settings_.seam.time, tick, period_ticks_,
                                     std::span(inputs).subspan(coordinates, all - 1 - coordinates));
          gains.push_back({leg, type, sensor, tick, queries.add(inputs)});
        }
      }
  const int outputs = static_cast<int>(layout_.output_names().size());
  const auto said = answers(network, queries.points(static_cast<int>(all)), outputs - 2, outputs);
  Modulation& modulation = parameters.modulation();
  for (const Gain& gain : gains) {
    const JointRange& range = joints_.ranges[to_index(joint(gain.leg, gain.type))];
    const double most_rad = settings_.modulation.shape * 0.5 * (range.upper_rad - range.lower_rad);
    const int group = (1 + gain.sensor) * modulation.width() + gain.type;
    modulation.entry(gain.leg, gain.tick)[group] = static_cast<float>(most_rad * said[to_index(gain.point)]);
    if (gain.tick == period_ticks_) repeat_last(modulation, gain.leg, group, period_ticks_);
  }
}

void SupgArchitecture::add_readings(const cppn::Network& network, ModulatedParameters& parameters) const {
  Modulation& modulation = parameters.modulation();
  const auto share = static_cast<float>(settings_.modulation.shape);
  for (int sensor = 0, channel = 0; sensor < sensors(); ++sensor)
    for (const float level : reading_levels) {
      std::vector<float> readings(to_index(sensors()));
      readings[to_index(sensor)] = level;
      const std::vector<float> patterns = layout_.patterns(network, readings);
      ++channel;
      for (int leg = 0; leg < legs(); ++leg)
        for (int type = 0; type < types(); ++type) {
          if (driver(leg, type) < 0) continue;
          const PatternTargets targets = pattern_targets(leg, type, patterns);
          const int group = channel * modulation.width() + type;
          for (int tick = 0; tick <= period_ticks_; ++tick)
            modulation.entry(leg, tick)[group] =
                share * (targets.at_rad(tick) - parameters.targets_rad(leg, tick)[type]);
          repeat_last(modulation, leg, group, period_ticks_);
        }
    }
}

}  // namespace amble::controllers
