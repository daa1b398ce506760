#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/network.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::controllers {

/// A robot with one joint of −1 … 1 rad and one leg.
inline robot::RobotSpec one_joint() {
  robot::RobotSpec robot;
  robot.joint_types = {"knee"};
  robot.legs.push_back({"L", {0}, {0}});
  robot::Joint& joint = robot.joints.emplace_back();
  joint.name = "L_knee";
  joint.lower_rad = -1.0;
  joint.upper_rad = 1.0;
  return robot;
}

/// A CPPN whose outputs are constants.
inline cppn::Network constant_cppn(int inputs, const std::vector<double>& outputs) {
  neat::Genome genome;
  std::uint32_t id = 0;
  for (int i = 0; i <= inputs; ++i)
    genome.nodes.push_back(
        {id++, i == 0 ? neat::NodeKind::bias : neat::NodeKind::input, neat::Activation::linear});
  for (const double output : outputs) {
    genome.nodes.push_back({id, neat::NodeKind::output, neat::Activation::linear});
    genome.links.push_back({id - static_cast<std::uint32_t>(inputs) - 1, 0, id, output});
    ++id;
  }
  return {genome, {cppn::Linear::identity, true}};
}

/// One network on that robot, told what its angle and its foot say.
class Bench {
 public:
  Bench(const Architecture& architecture, const std::vector<double>& outputs)
      : batch_(architecture.make_batch(1)),
        parameters_(
            architecture.decode(constant_cppn(static_cast<int>(architecture.cppn_inputs().size()), outputs))),
        sensors_{LaneArray(1, 1), LaneArray(1, 1), LaneArray(3, 1)},
        targets_(1, 1) {
    batch_->load(0, *parameters_);
  }

  robot::SensorFrame& sensors() { return sensors_; }
  /// The neurons' values after one more tick.
  std::vector<float> tick() {
    batch_->step(sensors_, targets_);
    std::vector<float> values(batch_->state_names().size());
    batch_->state(0, values);
    return values;
  }
  float target_rad() const { return targets_.at(0, 0); }

 private:
  std::unique_ptr<Batch> batch_;
  std::unique_ptr<Parameters> parameters_;
  robot::SensorFrame sensors_;
  LaneArray targets_;
};

}  // namespace amble::controllers
