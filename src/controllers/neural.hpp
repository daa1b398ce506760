#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/neural_kernel.hpp"
#include "amble/controllers/sensing.hpp"
#include "amble/controllers/wiring.hpp"

namespace amble::controllers {

/// Replaces each value x by 1/(1 + e^(−slope x)), to 1e−7 where slope x is exact; the same bits on every CPU.
void logistic(std::span<float> values, float slope);

/// A decoded network of neurons.
struct NeuralParameters : Parameters {
  substrate::Decoded decoded;
  std::vector<float> rates;  ///< of a CTRNN, neuron by neuron of the Wiring (ctrnn.hpp)
};

/// What all networks of one architecture have in common.
struct NeuralModel {
  std::string kind;
  std::vector<std::string> properties;  ///< that neurons have
  substrate::Layout layout;
  Wiring wiring;
  std::vector<JointRange> ranges;  ///< of the joints, in control order
  double timestep_s;
  double sine_period_s;
  substrate::Attitude attitude;
  std::vector<float> scales;  ///< of the sensors, slot by slot of the wiring
};

/// Controllers made of neurons in a substrate: the parts that static networks and CTRNNs share.
class NeuralArchitecture : public Architecture {
 public:
  std::string name() const override { return model_->kind; }
  const std::vector<std::string>& cppn_inputs() const override { return layout().input_names(); }
  const std::vector<std::string>& cppn_outputs() const override { return layout().output_names(); }
  const substrate::Layout* substrate() const override { return &layout(); }
  const substrate::Layout& layout() const { return model_->layout; }
  robot::ExtraSenses extra_senses() const override;
  bool reads(const substrate::Sensor& sensor) const override;
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override;
  std::string parameters_json(const Parameters& parameters) const override;

 protected:
  /// Throws UserError where substrate and robot do not fit; `properties` are those that neurons must have.
  NeuralArchitecture(std::string_view kind, std::vector<std::string> properties,
                     const substrate::Settings& substrate, const robot::RobotSpec& robot, double timestep_s,
                     const SensingSettings& sensing);

  std::shared_ptr<const NeuralModel> model_;
};

/// Networks stepping together. In a tick the sensors are read, the neurons advance(), and the values of the
/// neurons that drive joints, clamped to 0 … 1, are scaled to the joints' ranges. The state worth recording
/// is each neuron's value.
///
/// A neuron's weighted sum is that over the sensors, then that over the neurons, each in the order of the
/// layout's links; products are added by fused multiply-add, in single precision.
class NeuralBatch : public Batch {
 public:
  NeuralBatch(std::shared_ptr<const NeuralModel> model, int lanes);

  int lanes() const override { return lanes_; }
  void load(int lane, const Parameters& parameters) override;
  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override;
  std::vector<std::string> state_names() const override;
  void state(int lane, std::span<float> values) const override;

 protected:
  /// One tick of all lanes: from the sensors' values to those of the neurons.
  virtual void advance() = 0;
  /// Puts a lane into its initial state.
  virtual void reset(int lane, const NeuralParameters& parameters) = 0;

  const Wiring& wiring() const { return model_->wiring; }
  /// What a kernel works on.
  NeuralRows rows(float slope);

 private:
  void sense(const robot::SensorFrame& sensors);
  void sense_sine(float* row) const;
  void fill(SumTable& table, bool from_sensors) const;

  std::shared_ptr<const NeuralModel> model_;
  int lanes_;
  LaneRows weights_;            ///< link by link of the wiring
  std::vector<int> expressed_;  ///< link by link: number of lanes in which its weight is not 0
  bool links_known_ = false;    ///< whether the tables belong to the weights
  SumTable from_sensors_, from_neurons_;
  LaneRows values_;            ///< what the nodes say, slot by slot
  LaneRows sensed_, scratch_;  ///< neuron by neuron
  std::vector<int> tick_;      ///< lane by lane, from 0
};

}  // namespace amble::controllers
