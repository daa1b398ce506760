#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/kind_settings.hpp"

namespace amble::controllers {

/// An oscillator for each joint, the baseline of Raffin et al., "An Open-Loop Baseline for Reinforcement
/// Learning Locomotion Tasks" (arXiv 2310.05808, eq. 1). With amplitude a, phase shift φ and offset b of
/// joint i, and two frequencies that all share, its target is
///
///     b_i + a_i sin(θ_i + φ_i)   with   dθ_i/dt = 2π f_swing where sin(θ_i + φ_i) > 0, else 2π f_stance.
///
/// Nothing is sensed, unless settings.reset is `touch`: a foot that comes down after a tick in the air puts θ
/// of its leg's joints to 0, as a touch starts a SUPG's cycle.
///
/// The CPPN has no inputs: each output is one parameter, by the link from bias (and by more where NEAT has
/// added nodes), so that genomes are vectors of numbers and CMA-ES can search them. An output of −1 to 1 is a
/// frequency from least to most, an amplitude from 0 to half of the joint's range, a phase shift of a whole
/// turn, an offset from the lower to the upper end; targets stay in the range.
class OscillatorArchitecture : public Architecture {
 public:
  OscillatorArchitecture(const OscillatorSettings& settings, const robot::RobotSpec& robot,
                         double timestep_s);

  std::string name() const override { return "oscillators"; }
  const std::vector<std::string>& cppn_inputs() const override { return inputs_; }
  const std::vector<std::string>& cppn_outputs() const override { return outputs_; }
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override;
  std::unique_ptr<Batch> make_batch(int lanes) const override;
  std::string parameters_json(const Parameters& parameters) const override;
  bool reads(const substrate::Sensor& sensor) const override {
    return sensor.kind == substrate::Sensor::Kind::touch && settings_.reset == PhaseReset::touch;
  }
  bool scales(const substrate::Sensor&) const override { return false; }

 private:
  OscillatorSettings settings_;
  double timestep_s_;
  std::vector<std::string> leg_names_, joint_names_;
  std::vector<int> joints_;  ///< that a leg drives, by leg and type
  std::vector<int> legs_;    ///< of each of them
  std::vector<JointRange> ranges_;
  std::vector<std::pair<int, float>> held_rad_;  ///< other joints and their targets
  std::vector<std::string> inputs_, outputs_;
};

/// The parameters of one walker. Joints are those of the architecture, in its order.
struct OscillatorParameters : Parameters {
  float swing_turns = 0.0f, stance_turns = 0.0f;  ///< a tick
  std::vector<float> amplitude_rad, phase_turns, offset_rad;
};

/// sin(2π x) for x in [−1, 1], below 2e−7 off; only + − ×, the same bits anywhere.
float sine_of_turns(float x);

}  // namespace amble::controllers
