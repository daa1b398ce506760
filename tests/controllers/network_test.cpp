#include "amble/controllers/network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/controllers/one_joint.hpp"

namespace amble::controllers {
namespace network_test {

/// A sensor, a hidden neuron and a motor in a row.
substrate::Settings row_with(const std::string& sensor) {
  return substrate::substrate_of(R"(
coordinates = ["x"]
outputs = ["weight"]
sine_period_s = 0.4
nodes = [
  { name = "sensor", at = [-1], sensor = ")" +
                                 sensor + R"(" },
  { name = "hidden", at = [0] },
  { name = "motor", at = [1], joint = "L_knee" },
]
links = [ { from = "sensor", to = "hidden" }, { from = "hidden", to = "motor" } ]
)");
}

double s(double x) {
  return 1.0 / (1.0 + std::exp(-4.9 * x));
}

TEST(Logistic, IsAccurateToOneInTenMillion) {
  for (double x = -30.0; x <= 30.0; x += 0.0137) {
    auto value = static_cast<float>(x);
    const double exact = 1.0 / (1.0 + std::exp(-4.9 * static_cast<double>(value)));
    logistic({&value, 1}, 4.9f);
    // The product 4.9 x is rounded, too: up to half a unit in its last place, times the steepest slope.
    EXPECT_NEAR(value, exact, 1e-7 + std::fabs(x) * 4.9 * 6e-8 * 4 * exact * (1 - exact));
  }
}

TEST(Network, ComputesItsNeuronsFromTheSensors) {
  // o = 0.6 is a weight of (0.6 − 0.2)/0.8 × 3 = 1.5.
  const NetworkArchitecture architecture(NetworkSettings(), row_with("angle.L_knee"), one_joint(), 0.01);
  Bench bench(architecture, {0.6});
  for (const double angle : {-0.5, 0.0, 0.25}) {
    bench.sensors().joint_angle_rad.at(0, 0) = static_cast<float>(angle);
    const auto values = bench.tick();
    const double hidden = s(1.5 * angle), motor = s(1.5 * hidden);
    ASSERT_EQ(values.size(), 2u);
    EXPECT_NEAR(values[0], hidden, 1e-6);
    EXPECT_NEAR(values[1], motor, 1e-6);
    EXPECT_NEAR(bench.target_rad(), -1.0 + 2.0 * motor, 2e-6);
  }
}

TEST(Network, SensesTouchAndAttitude) {
  const std::pair<const char*, int> attitudes[] = {{"roll", 0}, {"pitch", 1}, {"yaw", 2}};
  for (const auto& [name, row] : attitudes) {
    const NetworkArchitecture architecture(NetworkSettings(), row_with(name), one_joint(), 0.01);
    Bench bench(architecture, {0.6});
    bench.sensors().attitude_rad.at(row, 0) = 0.125f;
    EXPECT_NEAR(bench.tick()[0], s(1.5 * 0.125), 1e-6) << name;
  }
  const NetworkArchitecture architecture(NetworkSettings(), row_with("touch.L"), one_joint(), 0.01);
  Bench bench(architecture, {0.6});
  EXPECT_NEAR(bench.tick()[0], 0.5, 1e-6);
  bench.sensors().touch.at(0, 0) = 1.0f;
  EXPECT_NEAR(bench.tick()[0], s(1.5), 1e-6);
}

TEST(Network, ReadsASineThatStartsFromZeroAtTheFirstTick) {
  const NetworkArchitecture architecture(NetworkSettings(), row_with("sine"), one_joint(), 0.01);
  Bench bench(architecture, {0.6});
  for (int tick = 0; tick < 1000; ++tick) {
    const double sine = std::sin(2.0 * std::numbers::pi * tick * 0.01 / 0.4);
    ASSERT_NEAR(bench.tick()[0], s(1.5 * sine), 2e-6) << tick;
  }
}

TEST(Network, ForgetsEachTick) {
  auto substrate = row_with("touch.L");
  auto& itself = substrate.links.emplace_back(substrate.links[0]);
  itself.from = itself.to = "hidden";
  const NetworkArchitecture architecture(NetworkSettings(), substrate, one_joint(), 0.01);
  Bench bench(architecture, {0.6});
  const auto first = bench.tick();
  bench.sensors().touch.at(0, 0) = 1.0f;
  EXPECT_NE(bench.tick(), first);
  bench.sensors().touch.at(0, 0) = 0.0f;
  EXPECT_EQ(bench.tick(), first);
}

TEST(Network, WritesItsParametersAsJson) {
  const NetworkArchitecture architecture(NetworkSettings(), row_with("sine"), one_joint(), 0.01);
  const auto parameters = architecture.decode(constant_cppn(2, {0.6}));
  const auto json = nlohmann::json::parse(architecture.parameters_json(*parameters));
  EXPECT_EQ(json["kind"], "network");
  EXPECT_EQ(json["coordinates"], nlohmann::json{"x"});
  EXPECT_EQ(json["nodes"].size(), 3u);
  EXPECT_EQ(json["nodes"][0]["role"], "sensor");
  EXPECT_EQ(json["nodes"][1]["role"], "hidden");
  EXPECT_EQ(json["nodes"][2]["role"], "joint");
  EXPECT_EQ(json["possible_links"], 2);
  ASSERT_EQ(json["links"].size(), 2u);
  EXPECT_EQ(json["links"][1]["source"], 1);
  EXPECT_EQ(json["links"][1]["target"], 2);
  EXPECT_FLOAT_EQ(json["links"][1]["weight"].get<float>(), 1.5f);
  const auto silent = architecture.decode(constant_cppn(2, {0.1}));
  EXPECT_TRUE(nlohmann::json::parse(architecture.parameters_json(*silent))["links"].empty());
}

}  // namespace network_test
}  // namespace amble::controllers
