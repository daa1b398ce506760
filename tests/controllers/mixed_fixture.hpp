#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/mixed.hpp"
#include "amble/core/random.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::controllers {

/// A mixed substrate of the quadruped: three sensors, three neurons, a link of every kind.
inline substrate::Settings mixed_substrate() {
  using substrate::Port;
  substrate::Settings settings;
  settings.coordinates = {"leg", "type", "layer"};
  settings.outputs = {"pattern", "offset", "weight", "bias", "tau"};
  const auto add = [&](const std::string& name, const std::string& group, std::vector<double> at) {
    auto& node = settings.nodes.emplace_back();
    node.name = name;
    node.group = group;
    node.at = std::move(at);
    return &node;
  };
  int i = 0;
  for (const std::string sensor : {"command_turn", "pitch", "angle.FR_knee"})
    add(sensor, "in", {0.1 * ++i, 0.0, -1.0})->sensor = sensor;
  for (i = 0; i < 3; ++i) add("n" + std::to_string(i), "neuron", {0.1 * i, 0.0, 0.0});
  const auto robot = quadruped();
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint)
    add("s" + std::to_string(joint), joint % 3 == 0 ? "lead" : "supg",
        {0.25 * static_cast<double>(joint / 3), 0.5 * static_cast<double>(joint % 3), 1.0})
        ->joint = robot.joints[joint].name;
  const auto link = [&](const char* from, const char* to, Port port) {
    settings.links.push_back({.from = from, .to = to, .weight = "weight", .same = {}, .port = port});
  };
  link("in", "neuron", Port::hidden);
  link("neuron", "neuron", Port::hidden);
  link("n0", "n0", Port::hidden);
  link("s4", "neuron", Port::hidden);
  for (const char* from : {"in", "neuron"}) {
    link(from, "lead", Port::rate);
    link(from, "supg", Port::amplitude);
    link(from, "supg", Port::shift);
  }
  link("lead", "lead", Port::coupling);
  const auto give = [&](const char* of, std::string_view property, const char* output) {
    auto& added = settings.properties.emplace_back();
    added.of = of;
    added.property = property;
    added.output = output;
    return &added;
  };
  for (const char* of : {"lead", "supg"}) {
    give(of, "pattern", "pattern");
    give(of, "offset", "offset")->zero = {"type"};
  }
  give("neuron", "bias", "bias");
  auto* const tau = give("neuron", "time_constant", "tau");
  tau->low = 0.01;
  tau->high = 0.5;
  return settings;
}

/// Random numbers for all that a CPPN gives. `expressed`: the share of links with a weight.
inline std::unique_ptr<MixedParameters> random_mixed(const MixedArchitecture& architecture, Stream& stream,
                                                     double expressed = 0.7) {
  const auto robot = quadruped();
  const auto ranges = joint_ranges(robot);
  const int period = architecture.period_ticks();
  SupgParameters targets(4, 3, period);
  for (int leg = 0; leg < 4; ++leg) {
    targets.set_offset_ticks(leg, 1 + static_cast<int>(stream.below(static_cast<std::uint32_t>(period - 1))));
    for (int timer = SupgParameters::stopped; timer <= period; ++timer)
      for (int type = 0; type < 3; ++type)
        targets.targets_rad(leg, timer)[type] =
            ranges[static_cast<std::size_t>(leg * 3 + type)].at(stream.uniform());
  }
  const MixedNet& net = architecture.net();
  auto mixed = std::make_unique<MixedParameters>(std::move(targets), architecture.layout().links().size(),
                                                 net.neurons.size(), net.couplings.size());
  const auto draw = [&] { return static_cast<float>(stream.uniform(-1.0, 1.0)); };
  for (std::size_t i = 0; i < mixed->weights.size(); ++i)
    if (architecture.layout().links()[i].port != substrate::Port::coupling && stream.chance(expressed))
      mixed->weights[i] = draw();
  for (float& bias : mixed->biases) bias = draw();
  for (float& step : mixed->steps) step = static_cast<float>(stream.uniform(0.02, 1.0));
  for (std::size_t k = 0; k < mixed->in_phase.size(); ++k)
    if (stream.chance(expressed)) {
      mixed->in_phase[k] = draw();
      mixed->out_of_phase[k] = draw();
    }
  return mixed;
}

}  // namespace amble::controllers
