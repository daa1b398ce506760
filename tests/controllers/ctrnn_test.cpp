#include "amble/controllers/ctrnn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "amble/core/error.hpp"
#include "tests/controllers/one_joint.hpp"

namespace amble::controllers {
namespace {

constexpr double time_constant = 8.0, bias = 0.25, weight = 1.5, slope = 4.9;

/// One neuron that hears its foot.
substrate::Settings one_neuron() {
  return substrate::substrate_of(R"(
coordinates = ["x"]
outputs = ["weight"]
nodes = [
  { name = "foot", group = "in", at = [-1], sensor = "touch.L" },
  { name = "motor", group = "out", at = [1], joint = "L_knee" },
]
links = [ { from = "in", to = "out" } ]
properties = [
  { of = "out", property = "bias", value = 0.25 },
  { of = "out", property = "time_constant", value = 8 },
]
)");
}

double s(double x) {
  return 1.0 / (1.0 + std::exp(-slope * x));
}

CtrnnSettings settings_of(Equation equation, Integrator integrator) {
  CtrnnSettings settings;
  settings.equation = equation;
  settings.integrator = integrator;
  settings.steps_per_tick = 1;
  settings.state = StateRule::kept;
  settings.slope = slope;
  return settings;
}

/// Values in 60 ticks after the foot came down, against the closed form of y(steps) for an aim of 1.
void expect_step_response(const CtrnnSettings& settings, const std::function<double(int)>& rise,
                          double tolerance) {
  const CtrnnArchitecture architecture(settings, one_neuron(), one_joint(), 0.01);
  Bench bench(architecture, {0.6});  // a weight of (0.6 − 0.2)/0.8 × 3 = 1.5
  bench.sensors().touch.at(0, 0) = 1.0f;
  for (int steps = 1; steps <= 60; ++steps) {
    const double value =
        settings.equation == Equation::rate ? s(weight - bias) * rise(steps) : s(weight * rise(steps) + bias);
    ASSERT_NEAR(bench.tick()[0], value, tolerance) << steps << " steps";
  }
}

TEST(Ctrnn, OneNeuronsStepResponseIsTheClosedForm) {
  // τ dy/dt = −y + F with constant F: y = F (1 − e^(−t/τ)).
  const auto exact = [](int steps) { return 1.0 - std::exp(-steps / time_constant); };
  // Euler's: y = F (1 − (1 − h/τ)^n).
  const auto euler = [](int steps) { return 1.0 - std::pow(1.0 - 1.0 / time_constant, steps); };
  for (const Equation equation : {Equation::rate, Equation::potential}) {
    expect_step_response(settings_of(equation, Integrator::exponential_euler), exact, 2e-6);
    // The classical method multiplies by 1 − x + x²/2 − x³/6 + x⁴/24 instead of e^−x, with x = 1/8.
    expect_step_response(settings_of(equation, Integrator::rk4), exact, 2e-6);
    expect_step_response(settings_of(equation, Integrator::euler), euler, 2e-6);
  }
}

TEST(Ctrnn, StepsManyTimesPerTickAndKeepsOrClearsItsState) {
  CtrnnSettings settings = settings_of(Equation::rate, Integrator::euler);
  settings.steps_per_tick = 17;
  for (const StateRule state : {StateRule::cleared, StateRule::kept}) {
    settings.state = state;
    const CtrnnArchitecture architecture(settings, one_neuron(), one_joint(), 0.01);
    Bench bench(architecture, {0.6});
    bench.sensors().touch.at(0, 0) = 1.0f;
    for (int tick = 1; tick <= 4; ++tick) {
      const int steps = state == StateRule::kept ? 17 * tick : 17;
      EXPECT_NEAR(bench.tick()[0], s(weight - bias) * (1.0 - std::pow(1.0 - 1.0 / time_constant, steps)),
                  2e-6);
    }
  }
}

TEST(Ctrnn, StepsByTheSettingInTheUnitOfTheTimeConstants) {
  CtrnnSettings settings = settings_of(Equation::rate, Integrator::exponential_euler);
  settings.step = 0.5;
  expect_step_response(
      settings, [](int steps) { return 1.0 - std::exp(-0.5 * steps / time_constant); }, 2e-6);
}

/// Two neurons with weights by four outputs of the CPPN, threshold 0 and range 5: an output o is the weight 5
/// o. Named as in "from 1 to 2".
substrate::Settings two_neurons(double bias_1, double bias_2) {
  auto substrate = substrate::substrate_of(R"(
coordinates = ["x"]
outputs = ["1 to 1", "1 to 2", "2 to 1", "2 to 2"]
expression_threshold = 0
weight_range = 5
nodes = [ { name = "1", at = [-1] }, { name = "2", at = [1], joint = "L_knee" } ]
links = [
  { from = "1", to = "1", weight = "1 to 1" },
  { from = "1", to = "2", weight = "1 to 2" },
  { from = "2", to = "1", weight = "2 to 1" },
  { from = "2", to = "2", weight = "2 to 2" },
]
properties = [
  { of = "1", property = "bias" },
  { of = "2", property = "bias" },
  { of = "1", property = "time_constant", value = 1 },
  { of = "2", property = "time_constant", value = 1 },
]
)");
  substrate.properties[0].value = bias_1;
  substrate.properties[1].value = bias_2;
  return substrate;
}

struct Oscillation {
  double period = 0.0;  ///< mean over the last upward crossings of neuron 1 through 1/2
  double amplitude = 0.0;
};

constexpr double step = 0.05;

/// Beer's equation, integrated by amble: self-weights w, from 1 to 2 −1, from 2 to 1 +1.
Oscillation oscillation(double w, double bias_1, double bias_2, Integrator integrator, double duration) {
  CtrnnSettings settings = settings_of(Equation::potential, integrator);
  settings.slope = 1.0;
  settings.step = step;
  const CtrnnArchitecture architecture(settings, two_neurons(bias_1, bias_2), one_joint(), 0.01);
  Bench bench(architecture, {w / 5.0, -1.0 / 5.0, 1.0 / 5.0, w / 5.0});
  std::vector<double> crossings;
  Oscillation found;
  double before = 0.5;
  for (int i = 0; i < duration / step; ++i) {
    const double now = bench.tick()[0];
    if (before < 0.5 && now >= 0.5) crossings.push_back((i + (0.5 - before) / (now - before)) * step);
    if (i * step > 0.75 * duration) found.amplitude = std::max(found.amplitude, now - 0.5);
    before = now;
  }
  constexpr std::size_t last = 5;
  if (crossings.size() > 2 * last)
    found.period = (crossings.back() - crossings[crossings.size() - 1 - last]) / last;
  return found;
}

/// The same circuit in double precision by another program of few lines: Heun's method with a tenth of the
/// step.
double plain_period(double w, double bias_1, double bias_2, double duration) {
  const auto o = [](double x) { return 1.0 / (1.0 + std::exp(-x)); };
  const double h = step / 10.0;
  double y1 = 0.0, y2 = 0.0, before = 0.5, first = 0.0, last = 0.0;
  int count = 0;
  for (int i = 0; i < duration / h; ++i) {
    const auto f1 = [&](double a, double b) { return -a + w * o(a + bias_1) + o(b + bias_2); };
    const auto f2 = [&](double a, double b) { return -b - o(a + bias_1) + w * o(b + bias_2); };
    const double k1 = f1(y1, y2), k2 = f2(y1, y2);
    const double l1 = f1(y1 + h * k1, y2 + h * k2), l2 = f2(y1 + h * k1, y2 + h * k2);
    y1 += 0.5 * h * (k1 + l1);
    y2 += 0.5 * h * (k2 + l2);
    const double now = o(y1 + bias_1);
    if (before < 0.5 && now >= 0.5 && i * h > 0.5 * duration) {
      last = (i + (0.5 - before) / (now - before)) * h;
      if (count++ == 0) first = last;
    }
    before = now;
  }
  return (last - first) / (count - 1);
}

// Beer (1995, Adaptive Behavior 3(4):469-509) publishes the oscillator with self-weights 4.5, cross-weights 1
// and −1, biases −2.75 and −1.75, and time constants 1; it is the worked example of several CTRNN programs,
// too. He publishes no number for its period. What follows from his analysis is checked instead: the biases
// are minus half the sum of a neuron's incoming weights, so y + bias = 0 is the equilibrium, where the slope
// of the logistic function is 1/4, and the eigenvalues are w/4 − 1 ± i √(1 · 1)/4. At w = 4 a limit cycle is
// born (a Hopf bifurcation) with the period 2π/(1/4) = 8π.
TEST(Ctrnn, BeersTwoNeuronsOscillateWithThePeriodOfTheirEigenvaluesWhereTheCycleIsBorn) {
  const double w = 4.02, bias_1 = -(w + 1.0) / 2.0, bias_2 = -(w - 1.0) / 2.0;
  const Oscillation born = oscillation(w, bias_1, bias_2, Integrator::rk4, 2500.0);
  EXPECT_NEAR(born.period, 8.0 * std::numbers::pi, 0.01 * 8.0 * std::numbers::pi);
  EXPECT_GT(born.amplitude, 0.03);
  EXPECT_LT(born.amplitude, 0.1) << "small near the bifurcation";
  // Below it they come to rest.
  const Oscillation none = oscillation(3.8, -2.4, -1.4, Integrator::rk4, 1000.0);
  EXPECT_LT(none.amplitude, 1e-4);
}

TEST(Ctrnn, BeersTwoNeuronsWithThePublishedWeightsOscillateAsADoublePrecisionProgramDoes) {
  const double expected = plain_period(4.5, -2.75, -1.75, 600.0);
  EXPECT_GT(expected, 8.0 * std::numbers::pi) << "the cycle slows down as it grows";
  const Oscillation found = oscillation(4.5, -2.75, -1.75, Integrator::rk4, 600.0);
  EXPECT_NEAR(found.period, expected, 1e-3 * expected);
  EXPECT_NEAR(found.amplitude, 0.31, 0.01);
  EXPECT_NEAR(oscillation(4.5, -2.75, -1.75, Integrator::euler, 600.0).period, expected, 0.05 * expected);
}

std::string refusal(const CtrnnSettings& settings, const substrate::Settings& substrate) {
  try {
    const CtrnnArchitecture architecture(settings, substrate, one_joint(), 0.01);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(Ctrnn, RefusesTimeConstantsThatItCannotIntegrate) {
  auto substrate = one_neuron();
  substrate.properties[1].value = 0.0;
  EXPECT_EQ(refusal(CtrnnSettings(), substrate),
            "controller.substrate.properties: a time constant can be 0: expected more than 0");
  substrate.properties[1].value = 0.5;
  EXPECT_EQ(refusal(CtrnnSettings(), substrate),
            "controller.ctrnn.step = 1: expected at most the shortest time constant, 0.5 (or integrator = "
            "\"exponential_euler\")");
  CtrnnSettings settings;
  settings.integrator = Integrator::exponential_euler;
  EXPECT_EQ(refusal(settings, substrate), "none");
}

}  // namespace
}  // namespace amble::controllers
