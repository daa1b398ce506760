// Networks stepping together against one plain network per lane, to the bit.
#include <gtest/gtest.h>

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include "amble/core/random.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/controllers/plain_network.hpp"
#include "tests/controllers/quadruped.hpp"
#include "tests/cppn/random_genome.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::controllers {
namespace {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, joints = 12;

/// A batch beside one plain network per lane.
template <typename Architecture, typename Settings>
class Pair {
 public:
  Pair(const Settings& settings, const substrate::Settings& substrate, int lanes, Stream& stream,
       const robot::RobotSpec& robot = quadruped(), bool load_all = true)
      : settings_(settings),
        robot_(robot),
        substrate_(substrate),
        architecture_(settings, substrate, robot, timestep_s),
        batch_(architecture_.make_batch(lanes)),
        sensors_{LaneArray(joints(), lanes), LaneArray(legs(), lanes), LaneArray(3, lanes)},
        targets_(joints(), lanes),
        parameters_(static_cast<std::size_t>(lanes)),
        plain_(static_cast<std::size_t>(lanes)),
        stream_(stream) {
    for (int lane = 0; lane < lanes; ++lane)
      if (load_all || lane % 3 == 1 || lanes == 1) load(lane);
  }

  void load(int lane) {
    const auto i = static_cast<std::size_t>(lane);
    const auto& layout = architecture_.layout();
    cppn::GenomeShape shape;
    shape.inputs = static_cast<int>(layout.input_names().size());
    shape.outputs = static_cast<int>(layout.output_names().size());
    shape.hidden = 3;
    const auto genome = cppn::random_genome(shape, stream_);
    auto parameters = architecture_.decode(cppn::Network(genome, {}));
    batch_->load(lane, *parameters);
    plain_[i].emplace(layout, dynamic_cast<const NeuralParameters&>(*parameters).decoded, timestep_s,
                      substrate_);
    parameters_[i] = std::move(parameters);
  }

  void step_and_compare() {
    for (LaneArray* rows : {&sensors_.joint_angle_rad, &sensors_.attitude_rad})
      for (int row = 0; row < rows->rows(); ++row)
        for (int lane = 0; lane < rows->lanes(); ++lane)
          rows->at(row, lane) = static_cast<float>(stream_.uniform(-3.0, 3.0));
    for (int leg = 0; leg < legs(); ++leg)
      for (int lane = 0; lane < batch_->lanes(); ++lane)
        sensors_.touch.at(leg, lane) = stream_.chance(0.5) ? 1.0f : 0.0f;
    batch_->step(sensors_, targets_);
    for (int lane = 0; lane < batch_->lanes(); ++lane)
      if (plain_[static_cast<std::size_t>(lane)]) compare(lane);
  }

 private:
  int joints() const { return static_cast<int>(robot_.joints.size()); }
  int legs() const { return static_cast<int>(robot_.legs.size()); }
  Senses senses(int lane) const {
    Senses senses;
    for (int row = 0; row < joints(); ++row)
      senses.angle_rad.push_back(sensors_.joint_angle_rad.at(row, lane));
    for (int row = 0; row < legs(); ++row) senses.touch.push_back(sensors_.touch.at(row, lane));
    for (int row = 0; row < 3; ++row) senses.attitude_rad.push_back(sensors_.attitude_rad.at(row, lane));
    return senses;
  }

  void compare(int lane) {
    PlainNetwork& plain = *plain_[static_cast<std::size_t>(lane)];
    plain.tick(settings_, senses(lane));
    for (int joint = 0; joint < joints(); ++joint)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(targets_.at(joint, lane)),
                std::bit_cast<std::uint32_t>(
                    plain.target_rad(joint, robot_.joints[static_cast<std::size_t>(joint)])))
          << "joint " << joint << ", lane " << lane;
    std::vector<float> state(batch_->state_names().size());
    batch_->state(lane, state);
    std::size_t next = 0;
    for (std::size_t node = 0; node < architecture_.layout().nodes().size(); ++node)
      if (!architecture_.layout().nodes()[node].sensor) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(state[next++]),
                  std::bit_cast<std::uint32_t>(plain.value(node)));
      }
  }

  Settings settings_;
  robot::RobotSpec robot_;
  substrate::Settings substrate_;
  Architecture architecture_;
  std::unique_ptr<Batch> batch_;
  robot::SensorFrame sensors_;
  LaneArray targets_;
  std::vector<std::unique_ptr<Parameters>> parameters_;
  std::vector<std::optional<PlainNetwork>> plain_;
  Stream& stream_;
};

/// Random substrates per instruction set, and the most ticks of any comparison: those without fused
/// multiply-adds take seconds for each under sanitizers.
#ifdef AMBLE_SANITIZED
constexpr int random_substrates = 5, most_ticks = 5;
#else
constexpr int random_substrates = 25, most_ticks = 100;
#endif

template <typename Architecture, typename Settings>
void expect_twins(const Settings& settings, const substrate::Settings& substrate,
                  std::initializer_list<int> lane_counts, int ticks, Stream& stream) {
  for (const int lanes : lane_counts) {
    Pair<Architecture, Settings> pair(settings, substrate, lanes, stream);
    for (int tick = 0; tick < std::min(ticks, most_ticks); ++tick) {
      // Now and then a lane gets another network while the others go on.
      if (stream.chance(0.1)) pair.load(static_cast<int>(stream.below(static_cast<std::uint32_t>(lanes))));
      ASSERT_NO_FATAL_FAILURE(pair.step_and_compare()) << lanes << " lanes, tick " << tick;
    }
  }
}

/// One joint and up to 60 nodes: sensors, neurons, links between any two of them, or without cycles, whatever
/// the order of the nodes.
substrate::Settings random_substrate(bool cyclic, bool ctrnn, Stream& stream) {
  substrate::Settings settings;
  settings.coordinates = {"x", "y"};
  settings.outputs = {"weight", "bias", "tau"};
  if (!ctrnn) settings.outputs.resize(1);
  settings.expression_threshold = stream.uniform(0.0, 0.7);
  const std::vector<std::string> sensors{"sine", "touch.L", "angle.L_knee", "roll", "pitch", "yaw"};
  const auto count = 1 + static_cast<int>(stream.below(60));
  for (int i = 0; i < count; ++i) {
    substrate::NodeSettings node;
    node.name = "n" + std::to_string(i);
    node.at = {stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0)};
    if (i + 1 == count)
      node.joint = "L_knee";
    else if (stream.chance(0.3))
      node.sensor = sensors[stream.below(static_cast<std::uint32_t>(sensors.size()))];
    if (ctrnn && node.sensor.empty()) {
      substrate::PropertySettings bias{.of = node.name, .output = "bias", .zero = {}};
      settings.properties.push_back(bias);
      bias.property = "time_constant";
      bias.output = "tau";
      bias.low = 1.0;
      bias.high = 61.0;
      settings.properties.push_back(bias);
    }
    settings.nodes.push_back(node);
  }
  std::vector<int> rank(static_cast<std::size_t>(count));
  std::iota(rank.begin(), rank.end(), 0);
  for (std::size_t i = rank.size(); i > 1; --i)
    std::swap(rank[i - 1], rank[stream.below(static_cast<std::uint32_t>(i))]);
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < 4 * count; ++i) {
    int from = static_cast<int>(stream.below(static_cast<std::uint32_t>(count))),
        to = static_cast<int>(stream.below(static_cast<std::uint32_t>(count)));
    if (!cyclic && from == to) continue;
    if (!cyclic && rank[static_cast<std::size_t>(from)] > rank[static_cast<std::size_t>(to)])
      std::swap(from, to);
    if (!pairs.emplace(from, to).second) continue;
    settings.links.push_back(
        {.from = "n" + std::to_string(from), .to = "n" + std::to_string(to), .same = {}});
  }
  // Without any link no output would be the weight.
  if (settings.links.empty())
    settings.links.push_back({.from = "n0", .to = settings.nodes.back().name, .same = {}});
  return settings;
}

/// Networks in random substrates, on one instruction set; some lanes are never loaded.
void expect_twins_in_random_substrates(int substrates, Stream& stream) {
  const robot::RobotSpec robot = one_joint();
  for (int i = 0; i < substrates; ++i) {
    const bool cyclic = stream.chance(0.5), all = stream.chance(0.5);
    const int lanes = stream.chance(0.5) ? 16 : 1;
    NetworkSettings network;
    network.passes = stream.chance(0.5) ? 17 : 1 + static_cast<int>(stream.below(60));
    Pair<NetworkArchitecture, NetworkSettings> passes(network, random_substrate(cyclic, false, stream), lanes,
                                                      stream, robot, all);
    CtrnnSettings ctrnn;
    ctrnn.equation = stream.chance(0.7) ? Equation::rate : Equation::potential;
    ctrnn.integrator = stream.chance(0.7) ? Integrator::euler : Integrator::rk4;
    ctrnn.state = stream.chance(0.5) ? StateRule::cleared : StateRule::kept;
    ctrnn.steps_per_tick = 1 + static_cast<int>(stream.below(18));
    Pair<CtrnnArchitecture, CtrnnSettings> steps(ctrnn, random_substrate(cyclic, true, stream), lanes, stream,
                                                 robot, all);
    for (int tick = 0; tick < 6; ++tick) {
      if (tick == 3) {
        passes.load(0);
        steps.load(lanes - 1);
      }
      ASSERT_NO_FATAL_FAILURE(passes.step_and_compare()) << "substrate " << i;
      ASSERT_NO_FATAL_FAILURE(steps.step_and_compare()) << "substrate " << i;
    }
  }
}

TEST(NeuralKernel, EqualsPlainNetworksInRandomSubstratesOnEveryInstructionSet) {
  const std::int64_t supported = hwy::SupportedTargets();
  Stream stream(44, Purpose::test);
  for (const std::int64_t set : {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_SCALAR}}) {
    if ((supported & set) == 0 && set != HWY_SCALAR) continue;
    hwy::SetSupportedTargetsForTest(set);
    ASSERT_NO_FATAL_FAILURE(expect_twins_in_random_substrates(random_substrates, stream))
        << hwy::TargetName(set);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(Logistic, HasTheBitsOfItsPlainTwinForAllMagnitudes) {
  Stream stream(45, Purpose::test);
  for (const float slope : {1e-3f, 1.0f, 4.9f, 1e3f}) {
    std::vector<float> given(20001);  // no whole number of vectors
    for (float& x : given)
      x = static_cast<float>(std::ldexp(stream.uniform(-1.0, 1.0), static_cast<int>(stream.below(40)) - 20));
    std::vector<float> values = given;
    logistic(values, slope);
    for (std::size_t i = 0; i < given.size(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(values[i]),
                std::bit_cast<std::uint32_t>(plain_logistic(given[i], slope)))
          << given[i];
  }
  for (const float x :
       {0.0f, -0.0f, std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()}) {
    float value = x;
    logistic({&value, 1}, 4.9f);
    ASSERT_EQ(value, plain_logistic(x, 4.9f));
  }
}

TEST(NetworkBatch, EqualsPlainNetworksOnTheSineSubstrate) {
  Stream stream(41, Purpose::test);
  expect_twins<NetworkArchitecture>(NetworkSettings(), substrate::part("sine"), {1, 3, 16, 21}, 12, stream);
}

TEST(NetworkBatch, EqualsPlainNetworksThatMisreadTheQuaternion) {
  Stream stream(44, Purpose::test);
  auto substrate = substrate::part("sine");
  substrate.attitude = substrate::Attitude::misordered_quaternion;
  expect_twins<NetworkArchitecture>(NetworkSettings(), substrate, {1, 3, 16, 21}, 12, stream);
}

TEST(NetworkBatch, EqualsPlainNetworksWithCyclesAndWithFewerPassesThanLevels) {
  Stream stream(42, Purpose::test);
  auto cyclic = substrate::part("ctrnn");
  cyclic.outputs = {"intra", "inter"};
  cyclic.properties.clear();
  NetworkSettings settings;
  for (const int passes : {1, 2, 17}) {
    settings.passes = passes;
    expect_twins<NetworkArchitecture>(settings, cyclic, {1, 16}, 10, stream);
  }
  settings.passes = 1;
  expect_twins<NetworkArchitecture>(settings, substrate::part("sine"), {1, 5}, 4, stream);
}

TEST(CtrnnBatch, EqualsPlainNetworksForAllSwitchesAndLaneCounts) {
  Stream stream(43, Purpose::test);
  for (const Equation equation : {Equation::rate, Equation::potential})
    for (const Integrator integrator : {Integrator::euler, Integrator::exponential_euler, Integrator::rk4})
      for (const StateRule state : {StateRule::kept, StateRule::cleared})
        for (const int steps : {1, 17}) {
          CtrnnSettings settings;
          settings.equation = equation;
          settings.integrator = integrator;
          settings.state = state;
          settings.steps_per_tick = steps;
          expect_twins<CtrnnArchitecture>(settings, substrate::part("ctrnn"), {1, 7, 16}, 15, stream);
        }
}

TEST(CtrnnBatch, StepsWithLanesThatWereNeverLoaded) {
  const CtrnnArchitecture architecture(CtrnnSettings(), substrate::part("ctrnn"), quadruped(), timestep_s);
  const auto batch = architecture.make_batch(16);
  const robot::SensorFrame sensors{LaneArray(joints, 16), LaneArray(legs, 16), LaneArray(3, 16)};
  LaneArray targets(joints, 16);
  for (int tick = 0; tick < 50; ++tick) batch->step(sensors, targets);
  for (int joint = 0; joint < joints; ++joint) EXPECT_LE(std::abs(targets.at(joint, 9)), 0.8f);
}

}  // namespace
}  // namespace amble::controllers
