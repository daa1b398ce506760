#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "amble/controllers/automatic.hpp"
#include "amble/controllers/factory.hpp"
#include "amble/controllers/mixed.hpp"
#include "amble/core/index.hpp"
#include "amble/io/json_file.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/robot/legged.hpp"

// The mixed substrate that is made from a robot.
namespace amble::controllers {
namespace {

using substrate::Port;

MixedArchitecture mixed_of_quadruped() {
  return {{}, {}, automatic_mixed(tests::legged_robot(2)), tests::legged_robot(2), 0.01, {}};
}

/// A CPPN whose output of this name is the same everywhere, and all others 0.
cppn::Network one_output(const substrate::Layout& layout, const std::string& output, double value) {
  const auto& names = layout.output_names();
  std::vector<double> values(names.size());
  values[to_index(std::ranges::find(names, output) - names.begin())] = value;
  return constant_cppn(static_cast<int>(layout.input_names().size()), values);
}

/// Which node is on which side: 1 left, −1 right.
double side_of_node(const substrate::Node& node) {
  return node.at[2];
}

TEST(AutomaticMixed, OneConstantOutputActsOnLeftAndRightInOppositeSenses) {
  const MixedArchitecture mixed = mixed_of_quadruped();
  const auto decoded = mixed.layout().decode(one_output(mixed.layout(), "turn_amplitude", 1.0));
  int left = 0, right = 0;
  for (std::size_t i = 0; i < decoded.weights.size(); ++i) {
    const substrate::Link& link = mixed.layout().links()[i];
    const auto& nodes = mixed.layout().nodes();
    const std::string& source = nodes[to_index(link.source)].name;
    const bool steers = link.port == Port::amplitude &&
                        (source == "command_turn" || source == "heading_error" || source == "yaw_rate");
    const double expected = steers ? 3.0 * side_of_node(nodes[to_index(link.target)]) : 0.0;
    EXPECT_FLOAT_EQ(decoded.weights[i], static_cast<float>(expected)) << source;
    (expected > 0.0 ? left : right) += steers ? 1 : 0;
  }
  EXPECT_EQ(left, 3 * 6);
  EXPECT_EQ(right, 3 * 6);
}

TEST(AutomaticMixed, OneConstantOutputBringsAllLegsToTheMiddleOfTheirRangesWhileAStopIsCommanded) {
  const MixedArchitecture mixed = mixed_of_quadruped();
  const auto parameters = mixed.decode(one_output(mixed.layout(), "stop_amplitude", -1.0));
  const auto batch = mixed.make_batch(1);
  batch->load(0, *parameters);
  const auto ranges = joint_ranges(tests::legged_robot(2));
  robot::SensorFrame sensors{
      .joint_angle_rad = LaneArray(12, 1), .touch = LaneArray(4, 1), .attitude_rad = LaneArray(3, 1)};
  sensors.yaw_rate_rad_s = LaneArray(1, 1);
  sensors.command = LaneArray(2, 1);
  sensors.heading_error_rad = LaneArray(1, 1);
  sensors.command_stop = LaneArray(1, 1);
  sensors.command_stop.at(0, 0) = 1.0f;
  LaneArray targets(12, 1);
  for (int tick = 0; tick < 200; ++tick) {
    batch->step(sensors, targets);
    for (int joint = 0; joint < 12; ++joint) {
      const JointRange& range = ranges[to_index(joint)];
      ASSERT_NEAR(targets.at(joint, 0), 0.5 * (range.lower_rad + range.upper_rad), 1e-6) << joint;
    }
  }
}

TEST(AutomaticMixed, WithoutNeuronsHasWhatActsOnSupgsByItselfAndNoOutputThatNothingReads) {
  ControllerSettings settings;
  settings.kind = "mixed";
  settings.substrate.layout = substrate::LayoutSource::automatic;
  const auto robot = tests::legged_robot(2);
  EXPECT_FALSE(io::settings_to_json(settings).contains("mixed")) << "two neurons a leg are implied";
  settings.mixed.neurons = LegNeurons::none;
  const auto made = make_architecture(settings, robot, 0.01);
  const auto& mixed = dynamic_cast<const MixedArchitecture&>(*made);
  EXPECT_TRUE(mixed.net().neurons.empty());
  EXPECT_EQ(mixed.net().sensors.size(), 5u);
  EXPECT_EQ(mixed.net().couplings.size(), 4u * 3u);
  for (const char* gone : {"hidden", "rate", "amplitude", "shift", "bias", "time_constant"})
    EXPECT_EQ(std::ranges::count(mixed.layout().output_names(), gone), 0) << gone;
  const auto full = mixed_of_quadruped();
  const auto to_supgs = [](const substrate::Layout& layout) {
    return std::ranges::count_if(layout.links(), [&](const substrate::Link& link) {
      const auto& from = layout.nodes()[to_index(link.source)];
      return link.port != Port::hidden && (from.sensor || from.joint >= 0);
    });
  };
  EXPECT_EQ(to_supgs(mixed.layout()), to_supgs(full.layout()));
}

TEST(AutomaticMixed, SensesCommandsAndEachFootAndHasTwoNeuronsALeg) {
  const MixedArchitecture mixed = mixed_of_quadruped();
  const auto& nodes = mixed.layout().nodes();
  const auto count = [&](const std::string& group) {
    return std::ranges::count(nodes, group, &substrate::Node::group);
  };
  EXPECT_EQ(count("stop"), 1);
  EXPECT_EQ(count("speed"), 1);
  EXPECT_EQ(count("turn"), 3);
  EXPECT_EQ(count("touch"), 4);
  EXPECT_EQ(count("hidden"), 8);
  EXPECT_EQ(count("lead"), 4);
  EXPECT_EQ(count("supg"), 8);
}

}  // namespace
}  // namespace amble::controllers
