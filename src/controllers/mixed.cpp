#include "amble/controllers/mixed.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/mixed_batch.hpp"
#include "amble/controllers/mixed_net.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {
namespace {

using substrate::Port;

/// cos 2πt and sin 2πt, the same on every CPU: a CPPN's sine is sin 2x.
std::pair<float, float> direction(double turns) {
  std::array<float, 2> both{static_cast<float>(std::numbers::pi * (turns + 0.25)),
                            static_cast<float>(std::numbers::pi * turns)};
  cppn::activate(neat::Activation::sine, cppn::Linear::identity, both);
  return {both[0], both[1]};
}

const MixedParameters& as_mixed(const Parameters& parameters) {
  const auto* const mixed = dynamic_cast<const MixedParameters*>(&parameters);
  AMBLE_CHECK(mixed != nullptr, "the parameters belong to another architecture");
  return *mixed;
}

}  // namespace

void MixedSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number(
      "rate", rate, {0.0, 10.0},
      {"what a source that says 1 adds to a leg's ρ by a rate link of the greatest weight: its rate "
       "is a factor of 2 to the power of ρ, within ± 1; 0: nothing"});
  visitor.number("amplitude", amplitude, {0.0, 10.0},
                 {"the same for amplitude: 1 doubles the pattern about the middle of the joint's range, −1 "
                  "leaves nothing of it"});
  visitor.number("shift", shift, {0.0, 10.0},
                 {"the same for shift: of the target, in halves of the joint's range"});
  visitor.number("coupling", coupling, {0.0, 10.0},
                 {"the same for coupling: ρ where the other leg is a quarter of a period ahead of where it "
                  "should be"});
}

MixedArchitecture::MixedArchitecture(const SupgSettings& supg, const MixedSettings& mixed,
                                     const substrate::Settings& substrate, const robot::RobotSpec& robot,
                                     double timestep_s, const SensingSettings& sensing)
    : SupgArchitecture(supg, substrate, robot, timestep_s, sensing,
                       {std::string(bias_property), std::string(time_constant_property)}),
      mixed_(mixed),
      weight_range_(substrate.weight_range) {
  if (!supg.modulation.sensors.empty())
    fail_setting({"controller.supg.modulation.sensors"},
                 "controller.supg.modulation.sensors: with kind mixed what SUPGs sense are nodes of the "
                 "substrate; expected none");
  net_ = std::make_shared<const MixedNet>(
      make_mixed_net(layout(), joints().of_legs, types(), robot, sensor_models(sensing, robot, timestep_s)));
  if (!net_->neurons.empty() && !(layout().lowest(time_constant_property) > 0.0))
    fail_setting({"controller.substrate.properties"},
                 "controller.substrate.properties: a time constant can be {}: expected more than 0",
                 layout().lowest(time_constant_property));
}

double MixedArchitecture::weight_gain(Port port) const {
  switch (port) {
    case Port::rate:
      return mixed_.rate / weight_range_;
    case Port::amplitude:
      return mixed_.amplitude / weight_range_;
    case Port::shift:
      return mixed_.shift / weight_range_;
    case Port::coupling:
      return mixed_.coupling / weight_range_;
    case Port::hidden:
      break;
  }
  return 1.0;
}

std::unique_ptr<Parameters> MixedArchitecture::decode(const cppn::Network& network) const {
  const substrate::Decoded decoded = layout().decode(network);
  auto parameters = std::make_unique<MixedParameters>(targets_of(decoded), decoded.weights.size(),
                                                      net_->neurons.size(), net_->couplings.size());
  const auto weight = [&](std::size_t link) {
    return static_cast<float>(static_cast<double>(decoded.weights[link]) *
                              weight_gain(layout().links()[link].port));
  };
  for (std::size_t i = 0; i < decoded.weights.size(); ++i)
    if (layout().links()[i].port != Port::coupling) parameters->weights[i] = weight(i);
  for (std::size_t n = 0; n < net_->neurons.size(); ++n) {
    const std::size_t node = to_index(net_->neurons[n]);
    parameters->biases[n] = decoded.of(bias_property)[node];
    // 1 − e^−x = 2t/(1 + t) with t = tanh(x/2), which is the bipolar sigmoid.
    float t =
        static_cast<float>(timestep_s() / static_cast<double>(decoded.of(time_constant_property)[node]));
    cppn::activate(neat::Activation::bipolar_sigmoid, cppn::Linear::identity, {&t, 1});
    parameters->steps[n] = 2.0f * t / (1.0f + t);
  }
  for (std::size_t k = 0; k < net_->couplings.size(); ++k) {
    const MixedNet::Coupling& coupling = net_->couplings[k];
    // A phase grows from the offset, or waits for it.
    const double ahead = parameters->offset_ticks(coupling.other) - parameters->offset_ticks(coupling.leg);
    const double turns = (settings().offset == Offset::phase ? ahead : -ahead) / period_ticks();
    const auto [cosine, sine] = direction(turns);
    const float c = weight(to_index(coupling.index));
    parameters->in_phase[k] = c * cosine;
    parameters->out_of_phase[k] = c * sine;
  }
  return parameters;
}

std::unique_ptr<Batch> MixedArchitecture::make_batch(int lanes) const {
  return std::make_unique<MixedBatch>(
      supgs(lanes), net_, neuron_names(),
      MixedParameters(blank(), layout().links().size(), net_->neurons.size(), net_->couplings.size()), lanes);
}

std::vector<std::string> MixedArchitecture::neuron_names() const {
  std::vector<std::string> names;
  for (const int node : net_->neurons) names.push_back(layout().nodes()[to_index(node)].name);
  return names;
}

robot::ExtraSenses MixedArchitecture::extra_senses() const {
  robot::ExtraSenses extra = SupgArchitecture::extra_senses();
  for (const LegSensor& sensor : net_->sensors) extra |= substrate::extra_senses(sensor.sensor);
  return extra;
}

std::string MixedArchitecture::parameters_json(const Parameters& parameters) const {
  const MixedParameters& mixed = as_mixed(parameters);
  using Json = nlohmann::ordered_json;
  Json json = Json::parse(SupgArchitecture::parameters_json(parameters));
  json["coordinates"] = layout().coordinates();
  json["nodes"] = Json::array();
  std::size_t neuron = 0, sensor = 0;
  for (const substrate::Node& node : layout().nodes()) {
    Json entry{{"name", node.name}, {"group", node.group}, {"at", node.at}};
    entry["role"] = node.sensor ? "sensor" : node.joint >= 0 ? "joint" : "hidden";
    if (node.sensor) {
      entry["gain"] = net_->sensors[sensor].gain;
      entry["shift"] = net_->sensors[sensor++].shift;
    } else if (node.joint < 0) {
      entry["bias"] = mixed.biases[neuron];
      entry["step"] = mixed.steps[neuron++];
    }
    json["nodes"].push_back(std::move(entry));
  }
  json["possible_links"] = layout().links().size();
  json["links"] = Json::array();
  std::size_t coupling = 0;
  for (std::size_t i = 0; i < layout().links().size(); ++i) {
    const substrate::Link& link = layout().links()[i];
    Json entry{{"source", link.source}, {"target", link.target}, {"weight", mixed.weights[i]}};
    entry["port"] = substrate::port_names[to_index(static_cast<int>(link.port))];
    bool expressed = mixed.weights[i] != 0.0f;
    if (link.port == Port::coupling) {
      const float in = mixed.in_phase[coupling], out = mixed.out_of_phase[coupling];
      ++coupling;
      expressed = in != 0.0f || out != 0.0f;
      entry["in_phase"] = in;
      entry["out_of_phase"] = out;
      entry["weight"] = std::sqrt(in * in + out * out);
    }
    if (expressed) json["links"].push_back(std::move(entry));
  }
  return json.dump();
}

}  // namespace amble::controllers
