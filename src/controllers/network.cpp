#include "amble/controllers/network.hpp"

#include <algorithm>
#include <utility>

namespace amble::controllers {
namespace {

class NetworkBatch final : public NeuralBatch {
 public:
  NetworkBatch(std::shared_ptr<const NeuralModel> model, const NetworkSettings& settings, int lanes)
      : NeuralBatch(std::move(model), lanes),
        slope_(static_cast<float>(settings.slope)),
        passes_(settings.passes),
        by_level_(!wiring().cyclic && wiring().depth() <= passes_),
        next_(wiring().neurons.size() * stride()) {}

 private:
  void advance() override {
    if (by_level_) {
      for (int level = 0; level < wiring().depth(); ++level) advance_level(static_cast<std::size_t>(level));
    } else {
      const auto all = neurons(0, wiring().neuron_count());
      std::ranges::fill(all, 0.0f);
      for (int pass = 0; pass < passes_; ++pass) {
        sum(0, wiring().neuron_count(), next_);
        logistic(next_, slope_);
        std::ranges::copy(next_, all.begin());
      }
    }
  }
  void advance_level(std::size_t level) {
    const int first = wiring().levels[level], last = wiring().levels[level + 1];
    const auto values = neurons(first, last);
    sum(first, last, values);
    logistic(values, slope_);
  }
  void reset(int, const NeuralParameters&) override {}

  float slope_;
  int passes_;
  bool by_level_;
  std::vector<float> next_;
};

}  // namespace

void NetworkSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("slope", slope, {1e-3, 1e3},
                 {"slope of the neurons' logistic function", "HyperSharpNEAT: 4.9"});
  visitor.integer("passes", passes, {1, 10000},
                  {"updates of all neurons in a tick, from a cleared state", "the authors' code: 17"});
}

NetworkArchitecture::NetworkArchitecture(const NetworkSettings& settings,
                                         const substrate::Settings& substrate,
                                         const morphology::RobotSpec& robot, double timestep_s)
    : NeuralArchitecture("network", {}, substrate, robot, timestep_s), settings_(settings) {}

std::unique_ptr<Batch> NetworkArchitecture::make_batch(int lanes) const {
  return std::make_unique<NetworkBatch>(model_, settings_, lanes);
}

}  // namespace amble::controllers
