#include "amble/controllers/neural.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "amble/controllers/sensing.hpp"
#include "amble/core/check.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {
namespace {

const NeuralParameters& as_neural(const Parameters& parameters) {
  const auto* const neural = dynamic_cast<const NeuralParameters*>(&parameters);
  AMBLE_CHECK(neural != nullptr, "the parameters belong to another architecture");
  return *neural;
}

}  // namespace

void logistic(std::span<float> values, float slope) {
  logistic_array(values.data(), values.size(), slope);
}

NeuralArchitecture::NeuralArchitecture(std::string_view kind, std::vector<std::string> properties,
                                       const substrate::Settings& substrate, const robot::RobotSpec& robot,
                                       double timestep_s, const SensingSettings& sensing) {
  substrate::Layout layout(
      substrate, {.kind = kind, .network = true, .properties = properties, .pattern_ticks = 0}, robot);
  Wiring wiring = make_wiring(layout);
  const std::vector<SensorModel> models = sensor_models(sensing, robot, timestep_s);
  std::vector<float> scales;
  for (const substrate::Sensor& sensor : wiring.sensors) scales.push_back(scale_of(models, sensor));
  model_ = std::make_shared<const NeuralModel>(NeuralModel{
      std::string(kind), std::move(properties), std::move(layout), std::move(wiring), joint_ranges(robot),
      timestep_s, substrate.sine_period_s, substrate.attitude, std::move(scales)});
}

robot::ExtraSenses NeuralArchitecture::extra_senses() const {
  robot::ExtraSenses extra;
  for (const substrate::Sensor& sensor : model_->wiring.sensors) extra |= substrate::extra_senses(sensor);
  return extra;
}

bool NeuralArchitecture::reads(const substrate::Sensor& sensor) const {
  return std::ranges::any_of(model_->wiring.sensors, [&](const substrate::Sensor& read) {
    return substrate::shares_rows(read, sensor);
  });
}

std::unique_ptr<Parameters> NeuralArchitecture::decode(const cppn::Network& network) const {
  auto parameters = std::make_unique<NeuralParameters>();
  parameters->decoded = layout().decode(network);
  return parameters;
}

std::string NeuralArchitecture::parameters_json(const Parameters& parameters) const {
  const substrate::Decoded& decoded = as_neural(parameters).decoded;
  using Json = nlohmann::ordered_json;
  Json json{{"kind", name()},
            {"coordinates", layout().coordinates()},
            {"nodes", Json::array()},
            {"possible_links", layout().links().size()},
            {"links", Json::array()}};
  for (std::size_t i = 0; i < layout().nodes().size(); ++i) {
    const substrate::Node& node = layout().nodes()[i];
    Json entry{{"name", node.name}, {"group", node.group}, {"at", node.at}};
    entry["role"] = node.sensor ? "sensor" : node.joint >= 0 ? "joint" : "hidden";
    for (const std::string& property : model_->properties)
      if (!node.sensor) entry[property] = decoded.of(property)[i];
    json["nodes"].push_back(std::move(entry));
  }
  for (std::size_t i = 0; i < decoded.weights.size(); ++i) {
    const substrate::Link& link = layout().links()[i];
    if (decoded.weights[i] != 0.0f)
      json["links"].push_back(
          {{"source", link.source}, {"target", link.target}, {"weight", decoded.weights[i]}});
  }
  return json.dump();
}

NeuralBatch::NeuralBatch(std::shared_ptr<const NeuralModel> model, int lanes)
    : model_(std::move(model)),
      lanes_(lanes),
      weights_(static_cast<int>(wiring().links.size()), lanes),
      expressed_(wiring().links.size()),
      values_(wiring().slots(), lanes),
      sensed_(wiring().neuron_count(), lanes),
      scratch_(wiring().neuron_count(), lanes),
      tick_(static_cast<std::size_t>(lanes)) {
  AMBLE_CHECK(lanes > 0, "a batch has at least one lane");
}

void NeuralBatch::load(int lane, const Parameters& parameters) {
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  const NeuralParameters& neural = as_neural(parameters);
  AMBLE_CHECK(neural.decoded.weights.size() == model_->layout.links().size(),
              "the parameters belong to another architecture");
  for (std::size_t k = 0; k < wiring().links.size(); ++k) {
    float& weight = weights_.at(static_cast<int>(k), lane);
    const float next = neural.decoded.weights[static_cast<std::size_t>(wiring().links[k].index)];
    expressed_[k] += (next != 0.0f ? 1 : 0) - (weight != 0.0f ? 1 : 0);
    weight = next;
  }
  links_known_ = false;
  for (int slot = 0; slot < wiring().slots(); ++slot) values_.at(slot, lane) = 0.0f;
  tick_[static_cast<std::size_t>(lane)] = 0;
  reset(lane, neural);
}

void NeuralBatch::step(const robot::SensorFrame& sensors, LaneArray& targets_rad) {
  AMBLE_CHECK(targets_rad.rows() == static_cast<int>(model_->ranges.size()) && targets_rad.lanes() == lanes_,
              "targets must be joints × lanes");
  if (!std::exchange(links_known_, true)) {
    fill(from_sensors_, true);
    fill(from_neurons_, false);
  }
  sense(sensors);
  advance();
  for (int& tick : tick_) ++tick;
  for (int joint = 0; joint < targets_rad.rows(); ++joint) {
    const int slot = wiring().joint_slots[static_cast<std::size_t>(joint)];
    float* const target_rad = targets_rad.row(joint);
    const JointRange& range = model_->ranges[static_cast<std::size_t>(joint)];
    if (slot < 0) {  // a joint that is held
      std::fill_n(target_rad, lanes_, range.at(0.0));
      continue;
    }
    const float* const value = values_.row(slot);
    for (int lane = 0; lane < lanes_; ++lane)
      target_rad[lane] = range.at(std::clamp(static_cast<double>(value[lane]), 0.0, 1.0));
  }
}

void NeuralBatch::sense(const robot::SensorFrame& sensors) {
  using Kind = substrate::Sensor::Kind;
  for (int slot = 0; slot < wiring().sensor_count(); ++slot) {
    const substrate::Sensor& sensor = wiring().sensors[static_cast<std::size_t>(slot)];
    float* const row = values_.row(slot);
    switch (sensor.kind) {
      case Kind::angle:
      case Kind::touch:
      case Kind::speed:
      case Kind::torque:
      case Kind::load:
      case Kind::yaw_rate:
      case Kind::command_speed:
      case Kind::command_turn:
      case Kind::command_stop:
      case Kind::heading_error: {
        const float* const from = substrate::row_of(sensor, sensors);
        AMBLE_CHECK(from != nullptr && sensors.touch.lanes() == lanes_, "the sensors are of another robot");
        std::copy_n(from, lanes_, row);
        break;
      }
      case Kind::roll:
      case Kind::pitch:
      case Kind::yaw:
        sense_attitude(sensor.kind, model_->attitude, sensors.attitude_rad,
                       {row, static_cast<std::size_t>(lanes_)});
        break;
      case Kind::sine:
        sense_sine(row);
    }
    if (const float scale = model_->scales[static_cast<std::size_t>(slot)]; scale != 1.0f)
      for (int lane = 0; lane < lanes_; ++lane) row[lane] *= scale;
  }
}

void NeuralBatch::sense_sine(float* row) const {
  for (std::size_t lane = 0; lane < tick_.size(); ++lane) {
    const double turns = tick_[lane] * model_->timestep_s / model_->sine_period_s;
    row[lane] = static_cast<float>((turns - std::floor(turns + 0.5)) * std::numbers::pi);
  }
  // A CPPN's sine is sin(2x).
  cppn::activate(neat::Activation::sine, cppn::Linear::identity, {row, tick_.size()});
}

/// Links that no lane expresses are left out: with finite values their products are zeros, which change no
/// sum but for the sign of a 0, and that is lost in the logistic function and beside the states y.
void NeuralBatch::fill(SumTable& table, bool from_sensors) const {
  const int first_source = from_sensors ? 0 : wiring().sensor_count();
  const auto offset = [&](int row) {
    return static_cast<std::uint32_t>(static_cast<std::size_t>(row) * values_.stride());
  };
  const auto expressed = [&](int n) {
    const Wiring::Neuron& neuron = wiring().neurons[static_cast<std::size_t>(n)];
    std::vector<int> links;
    for (int k = neuron.first_link; k < neuron.first_link + neuron.link_count; ++k) {
      const int source = wiring().links[static_cast<std::size_t>(k)].source_slot;
      if (expressed_[static_cast<std::size_t>(k)] > 0 && (source < wiring().sensor_count()) == from_sensors)
        links.push_back(k);
    }
    return links;
  };
  SumTableBuilder builder(table, static_cast<int>(wiring().links.size()), lanes_);
  for (std::size_t level = 0; level + 1 < wiring().levels.size(); ++level) {
    std::vector<std::pair<int, std::vector<int>>> neurons;
    for (int n = wiring().levels[level]; n < wiring().levels[level + 1]; ++n)
      neurons.emplace_back(n, expressed(n));
    std::ranges::stable_sort(neurons, {}, [](const auto& neuron) { return neuron.second.size(); });
    builder.begin_level();
    for (const auto& [n, links] : neurons) {
      builder.add_neuron(offset(n), static_cast<int>(links.size()));
      for (const int k : links)
        builder.add_link(offset(wiring().links[static_cast<std::size_t>(k)].source_slot - first_source),
                         weights_.row(k));
    }
  }
}

NeuralRows NeuralBatch::rows(float slope) {
  return {.from_sensors = from_sensors_,
          .from_neurons = from_neurons_,
          .sensors = values_.data(),
          .values = values_.row(wiring().sensor_count()),
          .sensed = sensed_.data(),
          .scratch = scratch_.data(),
          .neurons = wiring().neuron_count(),
          .lanes = lanes_,
          .stride = values_.stride(),
          .slope = slope};
}

std::vector<std::string> NeuralBatch::state_names() const {
  std::vector<std::string> names;
  for (const substrate::Node& node : model_->layout.nodes())
    if (!node.sensor) names.push_back("neuron." + node.name);
  return names;
}

void NeuralBatch::state(int lane, std::span<float> values) const {
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  AMBLE_CHECK(values.size() == wiring().neurons.size(), "one value per neuron");
  // The wiring orders neurons by level; names are in the order of the layout.
  std::vector<int> slot_of_node(model_->layout.nodes().size(), -1);
  for (int i = 0; i < wiring().neuron_count(); ++i)
    slot_of_node[static_cast<std::size_t>(wiring().neurons[static_cast<std::size_t>(i)].node)] =
        wiring().sensor_count() + i;
  std::size_t next = 0;
  for (const int slot : slot_of_node)
    if (slot >= 0) values[next++] = values_.at(slot, lane);
}

}  // namespace amble::controllers
