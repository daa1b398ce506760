#include "amble/controllers/ctrnn.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {
namespace {

class CtrnnBatch final : public NeuralBatch {
 public:
  CtrnnBatch(std::shared_ptr<const NeuralModel> model, const CtrnnSettings& settings, int lanes)
      : NeuralBatch(std::move(model), lanes),
        settings_(settings),
        slope_(static_cast<float>(settings.slope)) {
    const int neurons = wiring().neuron_count();
    bias_ = rate_ = LaneRows(neurons, lanes);
    if (rate_equation() && !runge_kutta()) return;
    trial_ = LaneRows(neurons, lanes);
    change_ = LaneRows(runge_kutta() ? 4 * neurons : 0, lanes);
    if (!rate_equation()) y_ = LaneRows(neurons, lanes);
  }

 private:
  bool rate_equation() const { return settings_.equation == Equation::rate; }
  bool runge_kutta() const { return settings_.integrator == Integrator::rk4; }

  void reset(int lane, const NeuralParameters& parameters) override {
    const auto bias = parameters.decoded.of(bias_property);
    for (int i = 0; i < wiring().neuron_count(); ++i) {
      const auto neuron = static_cast<std::size_t>(i);
      bias_.at(i, lane) = bias[static_cast<std::size_t>(wiring().neurons[neuron].node)];
      rate_.at(i, lane) = parameters.rates[neuron];
      // The rate equation's state is the neurons' values, which are 0 already.
      if (!rate_equation()) y_.at(i, lane) = 0.0f;
    }
  }

  void advance() override {
    const NeuralRows neural = rows(slope_);
    float* const y = rate_equation() ? neural.values : y_.data();
    const CtrnnRows ctrnn{y, bias_.data(), rate_.data(), trial_.data(), change_.data()};
    const bool cleared = settings_.state == StateRule::cleared;
    if (rate_equation() && !runge_kutta())
      return run_rate_euler(neural, ctrnn, settings_.steps_per_tick, cleared);
    if (cleared) std::fill_n(y, static_cast<std::size_t>(neural.neurons) * neural.stride, 0.0f);
    run_general(neural, ctrnn, settings_.steps_per_tick, !rate_equation(), runge_kutta());
  }

  CtrnnSettings settings_;
  float slope_;
  /// All of them neuron by neuron of the wiring, and empty where equation and method need none.
  LaneRows bias_, rate_, y_, trial_, change_;
};

}  // namespace

CtrnnArchitecture::CtrnnArchitecture(const CtrnnSettings& settings, const substrate::Settings& substrate,
                                     const robot::RobotSpec& robot, double timestep_s,
                                     const SensingSettings& sensing)
    : NeuralArchitecture("ctrnn", {std::string(bias_property), std::string(time_constant_property)},
                         substrate, robot, timestep_s, sensing),
      settings_(settings) {
  const double shortest = layout().lowest(time_constant_property);
  if (!(shortest > 0.0))
    fail_setting({"controller.substrate.properties"},
                 "controller.substrate.properties: a time constant can be {}: expected more than 0",
                 shortest);
  if (settings.integrator != Integrator::exponential_euler && settings.step > shortest)
    fail_setting(
        {"controller.ctrnn.step", "controller.ctrnn.integrator"},
        "controller.ctrnn.step = {}: expected at most the shortest time constant, {} (or integrator = "
        "\"exponential_euler\")",
        settings.step, shortest);
}

std::unique_ptr<Parameters> CtrnnArchitecture::decode(const cppn::Network& network) const {
  auto parameters = std::make_unique<NeuralParameters>();
  parameters->decoded = layout().decode(network);
  const auto time_constants = parameters->decoded.of(time_constant_property);
  for (const Wiring::Neuron& neuron : model_->wiring.neurons)
    parameters->rates.push_back(static_cast<float>(
        settings_.step / static_cast<double>(time_constants[static_cast<std::size_t>(neuron.node)])));
  if (settings_.integrator == Integrator::exponential_euler) {
    // 1 − e^−x = 2t/(1 + t) with t = tanh(x/2), which is the bipolar sigmoid.
    cppn::activate(neat::Activation::bipolar_sigmoid, cppn::Linear::identity, parameters->rates);
    for (float& rate : parameters->rates) rate = 2.0f * rate / (1.0f + rate);
  }
  return parameters;
}

std::unique_ptr<Batch> CtrnnArchitecture::make_batch(int lanes) const {
  return std::make_unique<CtrnnBatch>(model_, settings_, lanes);
}

}  // namespace amble::controllers
