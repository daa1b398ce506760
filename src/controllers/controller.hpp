#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/cppn/network.hpp"
#include "amble/robot/sensors.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/layout.hpp"

/// Controllers: what a CPPN becomes, and what drives a robot's joints.
namespace amble::controllers {

/// Parameters of one controller, made once per genome and const from then on. Each architecture derives its
/// own.
class Parameters {
 public:
  virtual ~Parameters() = default;
};

/// State of up to lanes() controllers of one architecture that step together, one per robot lane (structure
/// of arrays). Lanes do not influence each other. Belongs to one thread. A lane is 0 … lanes() − 1.
class Batch {
 public:
  virtual ~Batch() = default;

  /// As many as the engine's that it drives.
  virtual int lanes() const = 0;
  /// Puts a controller into a lane, in its initial state. `parameters` come from the same Architecture
  /// (AMBLE_CHECK in amble's own) and are not copied: they must live until the lane is loaded again.
  virtual void load(int lane, const Parameters& parameters) = 0;
  /// One tick: reads the sensors, advances the state, writes target angles (rad from the start pose, joints ×
  /// lanes, in control order) for all loaded lanes; what it writes for others means nothing. Targets lie
  /// within robot::Joint::command_range(); joints that are not driven get a constant one. `sensors` has the
  /// rows of Architecture::extra_senses(), too.
  virtual void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) = 0;

  /// Names of the state variables worth recording (for the SUPG: each leg's timer and trigger).
  virtual std::vector<std::string> state_names() const = 0;
  /// Their values in a lane after its last tick. `values` has as many elements as state_names(), in that
  /// order.
  virtual void state(int lane, std::span<float> values) const = 0;
  /// Those of state_names() that are 1 after a tick in which something happened and 0 else (for the SUPG: the
  /// triggers), as positions therein: worth counting.
  virtual std::vector<std::size_t> events() const { return {}; }
};

/// A kind of controller (SUPG, CTRNN, oscillators, …) for one robot: knows what its CPPN must look like and
/// how a CPPN becomes a controller. Const and shared by all workers.
class Architecture {
 public:
  virtual ~Architecture() = default;

  /// Its kind, for recordings and exports; amble's own have that of controller.kind.
  virtual std::string name() const = 0;
  /// Names of the CPPN's inputs, in order; the bias is not among them.
  virtual const std::vector<std::string>& cppn_inputs() const = 0;
  /// Names of the CPPN's outputs, in order; at least one.
  virtual const std::vector<std::string>& cppn_outputs() const = 0;
  /// The substrate, for pictures of it; null for controllers without.
  virtual const substrate::Layout* substrate() const { return nullptr; }
  /// What this CPPN makes of the controller. The network has as many inputs and outputs as named above
  /// (AMBLE_CHECK in amble's own). The parameters may outlive the network. Called by several threads at once.
  virtual std::unique_ptr<Parameters> decode(const cppn::Network& network) const = 0;
  /// Room for as many controllers, at least 1. In each lane load() comes before the first step() that counts.
  /// The architecture must outlive the batch.
  virtual std::unique_ptr<Batch> make_batch(int lanes) const = 0;
  /// What its sensors have to hold beside what engines give: in step() these rows are not empty.
  virtual robot::ExtraSenses extra_senses() const { return {}; }
  /// Whether its controllers read this sensor, so that how it is read ([controller.sensing]) has an effect;
  /// true where that is not known.
  virtual bool reads(const substrate::Sensor&) const { return true; }
  /// Whether they multiply it by its `scale`, and not only compare it, or steer by it as it is.
  virtual bool scales(const substrate::Sensor& sensor) const { return reads(sensor); }
  /// The parameters as JSON text, for recordings and exports (docs/FORMATS.md).
  virtual std::string parameters_json(const Parameters& parameters) const = 0;
};

}  // namespace amble::controllers
