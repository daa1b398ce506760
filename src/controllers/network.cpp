#include "amble/controllers/network.hpp"

#include <utility>

namespace amble::controllers {
namespace {

class NetworkBatch final : public NeuralBatch {
 public:
  NetworkBatch(std::shared_ptr<const NeuralModel> model, const NetworkSettings& settings, int lanes)
      : NeuralBatch(std::move(model), lanes),
        slope_(static_cast<float>(settings.slope)),
        passes_(settings.passes),
        by_level_(!wiring().cyclic && wiring().depth() <= passes_) {}

 private:
  void advance() override {
    if (by_level_)
      run_levels(rows(slope_));
    else
      run_passes(rows(slope_), passes_);
  }
  void reset(int, const NeuralParameters&) override {}

  float slope_;
  int passes_;
  bool by_level_;
};

}  // namespace

NetworkArchitecture::NetworkArchitecture(const NetworkSettings& settings,
                                         const substrate::Settings& substrate, const robot::RobotSpec& robot,
                                         double timestep_s, const SensingSettings& sensing)
    : NeuralArchitecture("network", {}, substrate, robot, timestep_s, sensing), settings_(settings) {}

std::unique_ptr<Batch> NetworkArchitecture::make_batch(int lanes) const {
  return std::make_unique<NetworkBatch>(model_, settings_, lanes);
}

}  // namespace amble::controllers
