#include "amble/controllers/wiring.hpp"

#include <algorithm>
#include <cstddef>

namespace amble::controllers {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The level of each node: 0 for sensors, else one more than the highest of its sources. Empty if there is a
/// cycle.
std::vector<int> levels_of(const substrate::Layout& layout) {
  const std::size_t count = layout.nodes().size();
  std::vector<int> level(count), waits_for(count), queue;
  std::vector<std::vector<int>> targets(count);
  const auto is_sensor = [&](std::size_t node) { return layout.nodes()[node].sensor.has_value(); };
  for (const substrate::Link& link : layout.links()) {
    if (is_sensor(at(link.target))) continue;
    targets[at(link.source)].push_back(link.target);
    ++waits_for[at(link.target)];
  }
  for (std::size_t node = 0; node < count; ++node) {
    level[node] = is_sensor(node) ? 0 : 1;
    if (waits_for[node] == 0) queue.push_back(static_cast<int>(node));
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int source = queue[next];
    for (const int target : targets[at(source)]) {
      level[at(target)] = std::max(level[at(target)], level[at(source)] + 1);
      if (--waits_for[at(target)] == 0) queue.push_back(target);
    }
  }
  return queue.size() == count ? level : std::vector<int>();
}

}  // namespace

Wiring make_wiring(const substrate::Layout& layout) {
  Wiring wiring;
  std::vector<int> level = levels_of(layout);
  wiring.cyclic = level.empty();
  level.resize(layout.nodes().size(), 1);
  std::vector<int> slot(layout.nodes().size());
  std::vector<int> neurons;
  for (std::size_t node = 0; node < slot.size(); ++node) {
    const auto& sensor = layout.nodes()[node].sensor;
    if (sensor) {
      slot[node] = wiring.sensor_count();
      wiring.sensors.push_back(*sensor);
    } else {
      neurons.push_back(static_cast<int>(node));
    }
  }
  std::ranges::stable_sort(neurons, {}, [&](int node) { return level[at(node)]; });
  for (const int node : neurons) {
    if (wiring.neurons.empty() || level[at(node)] != level[at(wiring.neurons.back().node)])
      wiring.levels.push_back(wiring.neuron_count());
    slot[at(node)] = wiring.slots();
    wiring.neurons.push_back({node, 0, 0});
  }
  wiring.levels.push_back(wiring.neuron_count());

  std::vector<std::vector<Wiring::Link>> incoming(slot.size());
  for (std::size_t i = 0; i < layout.links().size(); ++i) {
    const substrate::Link& link = layout.links()[i];
    incoming[at(link.target)].push_back({slot[at(link.source)], static_cast<int>(i)});
  }
  for (Wiring::Neuron& neuron : wiring.neurons) {
    const auto& its = incoming[at(neuron.node)];
    neuron.first_link = static_cast<int>(wiring.links.size());
    neuron.link_count = static_cast<int>(its.size());
    wiring.links.insert(wiring.links.end(), its.begin(), its.end());
  }
  for (int joint = 0; joint < layout.joint_count(); ++joint) {
    const int driver = layout.driver(joint);
    wiring.joint_slots.push_back(driver < 0 ? -1 : slot[at(driver)]);
  }
  return wiring;
}

}  // namespace amble::controllers
