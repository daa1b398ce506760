#include "amble/controllers/mixed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/mixed_batch.hpp"
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

using substrate::Port;

/// Collects the sums of a net, node by node.
class NetBuilder {
 public:
  NetBuilder(const substrate::Layout& layout, const std::vector<int>& of_legs, int types)
      : layout_(layout), of_legs_(of_legs), types_(types) {
    net_.rates.resize(of_legs.size() / to_index(types));
    net_.amplitudes.resize(of_legs.size());
    net_.shifts.resize(of_legs.size());
  }

  void add_nodes(const robot::RobotSpec& robot, const std::vector<SensorModel>& models) {
    for (std::size_t i = 0; i < layout_.nodes().size(); ++i) {
      const substrate::Node& node = layout_.nodes()[i];
      if (!node.sensor) continue;
      if (node.sensor->kind == substrate::Sensor::Kind::sine)
        fail_setting({"controller.substrate.nodes"},
                     "controller.substrate.nodes: \"{}\" is a clock: with kind mixed SUPGs are the clocks; "
                     "leave it out",
                     node.name);
      row_[static_cast<int>(i)] = static_cast<int>(net_.sensors.size());
      net_.sensors.push_back(scaled_sensor(*node.sensor, robot, models));
      net_.sensor_names.push_back(node.name);
    }
    for (std::size_t i = 0; i < layout_.nodes().size(); ++i) {
      const substrate::Node& node = layout_.nodes()[i];
      if (node.sensor || node.joint >= 0) continue;
      neuron_[static_cast<int>(i)] = net_.neurons.size();
      row_[static_cast<int>(i)] = net_.first_neuron() + static_cast<int>(net_.neurons.size());
      net_.neurons.push_back(static_cast<int>(i));
    }
    net_.hidden.resize(net_.neurons.size());
    for (const substrate::Link& link : layout_.links())
      if (link.port == Port::hidden && layout_.nodes()[to_index(link.source)].joint >= 0) listen(link.source);
  }

  void add_links() {
    for (std::size_t i = 0; i < layout_.links().size(); ++i) {
      const substrate::Link& link = layout_.links()[i];
      const int index = static_cast<int>(i);
      if (link.port == Port::coupling) {
        add_coupling(link, index);
        continue;
      }
      sum_of(link).links.push_back({row_.at(link.source), index});
    }
  }

  MixedNet take() { return std::move(net_); }

 private:
  std::size_t supg_of(int node) const {
    const int joint = layout_.nodes()[to_index(node)].joint;
    return to_index(std::ranges::find(of_legs_, joint) - of_legs_.begin());
  }
  int leg_of(int node) const { return static_cast<int>(supg_of(node)) / types_; }

  void listen(int node) {
    const auto [entry, is_new] =
        row_.try_emplace(node, net_.first_listened() + static_cast<int>(net_.listened.size()));
    if (is_new) net_.listened.push_back(static_cast<int>(supg_of(node)));
  }

  MixedNet::Sum& sum_of(const substrate::Link& link) {
    switch (link.port) {
      case Port::rate:
        return net_.rates[to_index(leg_of(link.target))];
      case Port::amplitude:
        return net_.amplitudes[supg_of(link.target)];
      case Port::shift:
        return net_.shifts[supg_of(link.target)];
      case Port::hidden:
      case Port::coupling:
        break;
    }
    return net_.hidden[neuron_.at(link.target)];
  }

  void add_coupling(const substrate::Link& link, int index) {
    const int leg = leg_of(link.target), other = leg_of(link.source);
    if (leg == other)
      fail_setting(
          {"controller.substrate.links"},
          "controller.substrate.links: coupling links \"{}\" to \"{}\", SUPGs of one leg, which have "
          "one phase",
          layout_.nodes()[to_index(link.source)].name, layout_.nodes()[to_index(link.target)].name);
    net_.couplings.push_back({leg, other, index});
  }

  const substrate::Layout& layout_;
  const std::vector<int>& of_legs_;
  int types_;
  std::map<int, int> row_;             ///< of a node that says something
  std::map<int, std::size_t> neuron_;  ///< of a node
  MixedNet net_;
};

}  // namespace

namespace {

/// Sensors of modulation would be one more way to sense.
const SupgSettings& without_sensors(const SupgSettings& supg) {
  if (!supg.modulation.sensors.empty())
    fail_setting({"controller.supg.modulation.sensors"},
                 "controller.supg.modulation.sensors: with kind mixed what SUPGs sense are nodes of the "
                 "substrate; expected none");
  if (supg.modulation.load_feedback > 0.0)
    fail_setting(
        {"controller.supg.modulation.load_feedback"},
        "controller.supg.modulation.load_feedback: with kind mixed what changes a timer's rate are links "
        "of the substrate; expected 0");
  return supg;
}

}  // namespace

MixedArchitecture::MixedArchitecture(const SupgSettings& supg, const MixedSettings& mixed,
                                     const substrate::Settings& substrate, const robot::RobotSpec& robot,
                                     double timestep_s, const SensingSettings& sensing)
    : SupgArchitecture(without_sensors(supg), substrate, robot, timestep_s, sensing,
                       {std::string(bias_property), std::string(time_constant_property)}),
      mixed_(mixed),
      weight_range_(substrate.weight_range),
      heading_lead_rad_(sensing.heading.lead_rad) {
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

bool MixedArchitecture::reads(const substrate::Sensor& sensor) const {
  return SupgArchitecture::reads(sensor) || scales(sensor);
}

bool MixedArchitecture::scales(const substrate::Sensor& sensor) const {
  return SupgArchitecture::scales(sensor) || std::ranges::any_of(net_->sensors, [&](const LegSensor& read) {
           return substrate::shares_rows(read.sensor, sensor);
         });
}

std::string MixedArchitecture::parameters_json(const Parameters& parameters) const {
  const MixedParameters& mixed = as_mixed(parameters);
  using Json = nlohmann::ordered_json;
  Json json = Json::parse(SupgArchitecture::parameters_json(parameters));
  if (heading_lead_rad_ > 0.0) json["heading_lead_rad"] = heading_lead_rad_;
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

MixedNet make_mixed_net(const substrate::Layout& layout, const std::vector<int>& of_legs, int types,
                        const robot::RobotSpec& robot, const std::vector<SensorModel>& models) {
  NetBuilder builder(layout, of_legs, types);
  builder.add_nodes(robot, models);
  builder.add_links();
  return builder.take();
}

}  // namespace amble::controllers
