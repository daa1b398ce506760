#include "amble/controllers/ctrnn.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {
namespace {

using substrate::Property;

class CtrnnBatch final : public NeuralBatch {
 public:
  CtrnnBatch(std::shared_ptr<const NeuralModel> model, const CtrnnSettings& settings, int lanes)
      : NeuralBatch(std::move(model), lanes),
        settings_(settings),
        slope_(static_cast<float>(settings.slope)) {
    for (auto* const rows : {&y_, &bias_, &rate_, &trial_, &k1_, &k2_, &k3_, &k4_})
      rows->resize(wiring().neurons.size() * stride());
  }

 private:
  void reset(int lane, const NeuralParameters& parameters) override {
    const auto bias = parameters.decoded.of(Property::bias);
    for (int i = 0; i < wiring().neuron_count(); ++i) {
      const auto neuron = static_cast<std::size_t>(i);
      y_[index(i, lane)] = 0.0f;
      bias_[index(i, lane)] = bias[static_cast<std::size_t>(wiring().neurons[neuron].node)];
      rate_[index(i, lane)] = parameters.rates[neuron];
    }
  }

  void advance() override {
    if (settings_.state == StateRule::cleared) std::ranges::fill(y_, 0.0f);
    for (int step = 0; step < settings_.steps_per_tick; ++step) {
      if (settings_.integrator == Integrator::rk4) {
        runge_kutta_step();
      } else {
        find_change(y_, k1_);
        for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += k1_[i];
      }
    }
    show(y_);
  }

  void runge_kutta_step() {
    find_change(y_, k1_);
    find_change(ahead(k1_, 0.5f), k2_);
    find_change(ahead(k2_, 0.5f), k3_);
    find_change(ahead(k3_, 1.0f), k4_);
    for (std::size_t i = 0; i < y_.size(); ++i)
      y_[i] += (k1_[i] + 2.0f * k2_[i] + 2.0f * k3_[i] + k4_[i]) * (1.0f / 6.0f);
  }
  const std::vector<float>& ahead(const std::vector<float>& change, float share) {
    for (std::size_t i = 0; i < y_.size(); ++i) trial_[i] = y_[i] + share * change[i];
    return trial_;
  }

  /// change = rate × (F(y) − y).
  void find_change(const std::vector<float>& y, std::vector<float>& change) {
    show(y);
    sum(0, wiring().neuron_count(), change);
    if (settings_.equation == Equation::rate) {
      for (std::size_t i = 0; i < y.size(); ++i) change[i] -= bias_[i];
      logistic(change, slope_);
    }
    for (std::size_t i = 0; i < y.size(); ++i) change[i] = rate_[i] * (change[i] - y[i]);
  }

  /// Gives the neurons the values that belong to y.
  void show(const std::vector<float>& y) {
    const auto values = neurons(0, wiring().neuron_count());
    std::ranges::copy(y, values.begin());
    if (settings_.equation == Equation::rate) return;
    for (std::size_t i = 0; i < y.size(); ++i) values[i] += bias_[i];
    logistic(values, slope_);
  }

  CtrnnSettings settings_;
  float slope_;
  /// All of them neuron by neuron of the wiring, over the lanes.
  std::vector<float> y_, bias_, rate_;
  std::vector<float> trial_, k1_, k2_, k3_, k4_;
};

}  // namespace

void CtrnnSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("equation", equation, equation_names,
                 {"what is integrated: the neurons' values (rate: τ dy/dt = −y + s(Σ w y − bias)) or their "
                  "potentials (potential: τ dy/dt = −y + Σ w s(y + bias))",
                  "the authors' code: rate; Beer 1995, eq. 1: potential"});
  visitor.choice("integrator", integrator, integrator_names,
                 {"how it is integrated", "the authors' code: euler"});
  visitor.number(
      "step", step, {1e-6, 1e6},
      {"length of one step of the integrator, in the unit of the time constants", "the authors' code: 1"});
  visitor.integer("steps_per_tick", steps_per_tick, {1, 10000},
                  {"steps of the integrator in a tick", "the authors' code: 17"});
  visitor.choice("state", state, state_rule_names,
                 {"whether the neurons' state is kept from tick to tick or cleared before each",
                  "the authors' code: cleared; Morse et al. 2013: a CTRNN, so kept"});
  visitor.number("slope", slope, {1e-3, 1e3},
                 {"slope of the neurons' logistic function", "HyperSharpNEAT: 4.9; Beer 1995: 1"});
}

CtrnnArchitecture::CtrnnArchitecture(const CtrnnSettings& settings, const substrate::Settings& substrate,
                                     const morphology::RobotSpec& robot, double timestep_s)
    : NeuralArchitecture("ctrnn", {Property::bias, Property::time_constant}, substrate, robot, timestep_s),
      settings_(settings) {
  const double shortest = layout().lowest(Property::time_constant);
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
  const auto time_constants = parameters->decoded.of(Property::time_constant);
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
