// Networks stepping together against one plain network per lane, to the bit.
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <optional>

#include "amble/core/random.hpp"
#include "tests/controllers/plain_network.hpp"
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
  Pair(const Settings& settings, const substrate::Settings& substrate, int lanes, Stream& stream)
      : settings_(settings),
        substrate_(substrate),
        architecture_(settings, substrate, quadruped(), timestep_s),
        batch_(architecture_.make_batch(lanes)),
        sensors_{LaneArray(joints, lanes), LaneArray(legs, lanes), LaneArray(3, lanes)},
        targets_(joints, lanes),
        parameters_(static_cast<std::size_t>(lanes)),
        plain_(static_cast<std::size_t>(lanes)),
        stream_(stream) {
    for (int lane = 0; lane < lanes; ++lane) load(lane);
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
    for (int leg = 0; leg < legs; ++leg)
      for (int lane = 0; lane < batch_->lanes(); ++lane)
        sensors_.touch.at(leg, lane) = stream_.chance(0.5) ? 1.0f : 0.0f;
    batch_->step(sensors_, targets_);
    for (int lane = 0; lane < batch_->lanes(); ++lane) compare(lane);
  }

 private:
  Senses senses(int lane) const {
    Senses senses;
    for (int row = 0; row < joints; ++row) senses.angle_rad.push_back(sensors_.joint_angle_rad.at(row, lane));
    for (int row = 0; row < legs; ++row) senses.touch.push_back(sensors_.touch.at(row, lane));
    for (int row = 0; row < 3; ++row) senses.attitude_rad.push_back(sensors_.attitude_rad.at(row, lane));
    return senses;
  }

  void compare(int lane) {
    PlainNetwork& plain = *plain_[static_cast<std::size_t>(lane)];
    plain.tick(settings_, senses(lane));
    for (int joint = 0; joint < joints; ++joint)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(targets_.at(joint, lane)),
                std::bit_cast<std::uint32_t>(plain.target_rad(joint)))
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
  substrate::Settings substrate_;
  Architecture architecture_;
  std::unique_ptr<Batch> batch_;
  physics::SensorFrame sensors_;
  LaneArray targets_;
  std::vector<std::unique_ptr<Parameters>> parameters_;
  std::vector<std::optional<PlainNetwork>> plain_;
  Stream& stream_;
};

template <typename Architecture, typename Settings>
void expect_twins(const Settings& settings, const substrate::Settings& substrate,
                  std::initializer_list<int> lane_counts, int ticks, Stream& stream) {
  for (const int lanes : lane_counts) {
    Pair<Architecture, Settings> pair(settings, substrate, lanes, stream);
    for (int tick = 0; tick < ticks; ++tick) {
      // Now and then a lane gets another network while the others go on.
      if (stream.chance(0.1)) pair.load(static_cast<int>(stream.below(static_cast<std::uint32_t>(lanes))));
      ASSERT_NO_FATAL_FAILURE(pair.step_and_compare()) << lanes << " lanes, tick " << tick;
    }
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
  const physics::SensorFrame sensors{LaneArray(joints, 16), LaneArray(legs, 16), LaneArray(3, 16)};
  LaneArray targets(joints, 16);
  for (int tick = 0; tick < 50; ++tick) batch->step(sensors, targets);
  for (int joint = 0; joint < joints; ++joint) EXPECT_LE(std::abs(targets.at(joint, 9)), 0.8f);
}

}  // namespace
}  // namespace amble::controllers
