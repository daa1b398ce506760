#pragma once

#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/neural.hpp"

namespace amble::controllers {

/// Static neurons in a substrate: value = 1/(1 + e^(−slope Σ weight × value of the source)). With a node
/// whose sensor is "sine" this is the sine wave architecture (Morse et al. 2013, sec. 4 and figure 6).
///
/// In each tick all neurons start from 0 and are updated together, `passes` times. Where the links form no
/// cycle and no way is longer than that, one pass level by level gives the same bits.
class NetworkArchitecture : public NeuralArchitecture {
 public:
  NetworkArchitecture(const NetworkSettings& settings, const substrate::Settings& substrate,
                      const robot::RobotSpec& robot, double timestep_s, const SensingSettings& sensing = {});
  std::unique_ptr<Batch> make_batch(int lanes) const override;

 private:
  NetworkSettings settings_;
};

}  // namespace amble::controllers
