#include "amble/controllers/mixed_net.hpp"

#include <algorithm>
#include <map>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

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

MixedNet make_mixed_net(const substrate::Layout& layout, const std::vector<int>& of_legs, int types,
                        const robot::RobotSpec& robot, const std::vector<SensorModel>& models) {
  NetBuilder builder(layout, of_legs, types);
  builder.add_nodes(robot, models);
  builder.add_links();
  return builder.take();
}

}  // namespace amble::controllers
