#pragma once

#include <vector>

#include "amble/substrate/layout.hpp"

namespace amble::controllers {

/// A layout translated for evaluation. Each node has a slot: first the sensors, then the neurons. Links into
/// sensors have no effect and are left out: a sensor's value is what is sensed.
struct Wiring {
  /// The links [first_link, first_link + link_count) lead to it, in the order of the layout.
  struct Neuron {
    int node = 0;
    int first_link = 0, link_count = 0;
  };
  struct Link {
    int source_slot = 0;
    int index = 0;  ///< in Layout::links()
  };

  std::vector<substrate::Sensor> sensors;  ///< slot by slot
  std::vector<Neuron> neurons;             ///< slot sensors.size() + index
  std::vector<Link> links;
  std::vector<int> joint_slots;  ///< the slot that drives each joint; −1: it is held
  /// Where each level of neurons begins, and the end. The sources of a level lie in the levels before it.
  /// If the links form a cycle, there is one level of all neurons in the order of the layout.
  std::vector<int> levels;
  bool cyclic = false;

  /// Longest way from a sensor or a neuron without links to a neuron, in neurons. Only if there is no cycle.
  int depth() const { return static_cast<int>(levels.size()) - 1; }
  int sensor_count() const { return static_cast<int>(sensors.size()); }
  int neuron_count() const { return static_cast<int>(neurons.size()); }
  int slots() const { return sensor_count() + neuron_count(); }
};

Wiring make_wiring(const substrate::Layout& layout);

}  // namespace amble::controllers
