#include "amble/controllers/mixed.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "amble/controllers/supg_batch.hpp"
#include "amble/core/error.hpp"
#include "tests/controllers/mixed_fixture.hpp"
#include "tests/controllers/plain_mixed.hpp"

namespace amble::controllers {
namespace mixed_test {

constexpr double timestep_s = 0.01;
constexpr int legs = PlainMixed::legs, types = PlainMixed::types, joints = PlainMixed::joints,
              neurons = PlainMixed::neurons, period = PlainMixed::period;

SupgSettings supg_settings() {
  SupgSettings settings;
  settings.period_s = period * timestep_s;
  return settings;
}

MixedArchitecture architecture(const SupgSettings& supg, const MixedSettings& mixed = {}) {
  return {supg, mixed, mixed_substrate(), quadruped(), timestep_s, {}};
}

robot::SensorFrame frame(int lanes) {
  robot::SensorFrame sensors{.joint_angle_rad = LaneArray(joints, lanes),
                             .touch = LaneArray(legs, lanes),
                             .attitude_rad = LaneArray(3, lanes)};
  sensors.command = LaneArray(2, lanes);
  return sensors;
}

void move_randomly(robot::SensorFrame& sensors, Stream& stream) {
  for (int lane = 0; lane < sensors.touch.lanes(); ++lane) {
    for (int leg = 0; leg < legs; ++leg)
      if (stream.chance(0.2)) sensors.touch.at(leg, lane) = 1.0f - sensors.touch.at(leg, lane);
    for (int joint = 0; joint < joints; ++joint)
      sensors.joint_angle_rad.at(joint, lane) = static_cast<float>(stream.uniform(-0.9, 0.9));
    for (int axis = 0; axis < 3; ++axis)
      sensors.attitude_rad.at(axis, lane) = static_cast<float>(stream.uniform(-0.7, 0.7));
    sensors.command.at(1, lane) = static_cast<float>(stream.uniform(-1.5, 1.5));
  }
}

TEST(Mixed, EqualsItsPlainTwinForAllSwitchesAndLaneCounts) {
  Stream stream(71, Purpose::test);
  for (const Trigger trigger : {Trigger::edge, Trigger::none})
    for (const Offset offset : {Offset::phase, Offset::delay})
      for (const Idle idle : {Idle::mid, Idle::hold, Idle::wrap})
        for (const int lanes : {1, 5, 16, 33}) {
          SupgSettings settings = supg_settings();
          settings.trigger = trigger;
          settings.offset = offset;
          settings.idle = idle;
          const MixedArchitecture mixed = architecture(settings);
          const auto batch = mixed.make_batch(lanes);
          std::vector<std::unique_ptr<MixedParameters>> parameters;
          std::vector<PlainMixed> plain;
          for (int lane = 0; lane < lanes; ++lane) {
            parameters.push_back(random_mixed(mixed, stream, lane % 3 == 0 ? 0.2 : 0.8));
            batch->load(lane, *parameters.back());
            plain.emplace_back(mixed, settings, *parameters.back());
          }
          auto sensors = frame(lanes);
          LaneArray targets(joints, lanes);
          std::vector<float> state(batch->state_names().size());
          for (int tick = 0; tick < 60; ++tick) {
            move_randomly(sensors, stream);
            batch->step(sensors, targets);
            for (int lane = 0; lane < lanes; ++lane) {
              PlainMixed& twin = plain[static_cast<std::size_t>(lane)];
              twin.tick(sensors, lane);
              batch->state(lane, state);
              for (int leg = 0; leg < legs; ++leg)
                ASSERT_EQ(state[static_cast<std::size_t>(leg)], twin.timer(leg)) << tick << " " << lane;
              for (std::size_t n = 0; n < neurons; ++n)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(state[2 * legs + n]),
                          std::bit_cast<std::uint32_t>(twin.neuron(n)))
                    << tick << " " << lane;
              for (int joint = 0; joint < joints; ++joint)
                ASSERT_EQ(targets.at(joint, lane), twin.target_rad(joint)) << tick << " " << joint;
            }
          }
        }
}

TEST(Mixed, WithAllGainsZeroIsTheSupgsAloneToTheBit) {
  Stream stream(72, Purpose::test);
  for (const bool smooth : {false, true}) {
    SupgSettings settings = supg_settings();
    if (smooth) settings.seam = {.residual_s = 0.03, .filter_s = 0.02};
    const MixedArchitecture mixed =
        architecture(settings, {.rate = 0.0, .amplitude = 0.0, .shift = 0.0, .coupling = 0.0});
    constexpr int lanes = 17;
    const auto batch = mixed.make_batch(lanes);
    SupgJoints all;
    for (int joint = 0; joint < joints; ++joint) all.of_legs.push_back(joint);
    all.ranges = joint_ranges(quadruped());
    SupgBatch plain(settings, timestep_s, {"FL", "FR", "BL", "BR"}, all, *random_mixed(mixed, stream), lanes);
    std::vector<std::unique_ptr<MixedParameters>> parameters;
    for (int lane = 0; lane < lanes; ++lane) {
      auto one = random_mixed(mixed, stream);
      // As decode() has it: of all links only the hidden ones are left.
      for (std::size_t i = 0; i < one->weights.size(); ++i)
        if (mixed.layout().links()[i].port != substrate::Port::hidden) one->weights[i] = 0.0f;
      std::ranges::fill(one->in_phase, 0.0f);
      std::ranges::fill(one->out_of_phase, 0.0f);
      parameters.push_back(std::move(one));
      batch->load(lane, *parameters.back());
      plain.load(lane, *parameters.back());
    }
    auto sensors = frame(lanes);
    LaneArray targets(joints, lanes), expected(joints, lanes);
    for (int tick = 0; tick < 80; ++tick) {
      move_randomly(sensors, stream);
      batch->step(sensors, targets);
      plain.step(sensors, expected);
      for (int joint = 0; joint < joints; ++joint)
        for (int lane = 0; lane < lanes; ++lane)
          ASSERT_EQ(std::bit_cast<std::uint32_t>(targets.at(joint, lane)),
                    std::bit_cast<std::uint32_t>(expected.at(joint, lane)));
    }
  }
}

/// What a batch of smoothed targets says beside one of plain ones, both told the same for some ticks.
void expect_as_without_seam(const SeamSettings& seam, int ticks) {
  constexpr int lanes = 17;
  SupgSettings settings = supg_settings();
  settings.trigger = Trigger::none;
  settings.idle = Idle::hold;
  const MixedArchitecture plain = architecture(settings);
  settings.seam = seam;
  const MixedArchitecture smooth = architecture(settings);
  const auto batch = smooth.make_batch(lanes), expected = plain.make_batch(lanes);
  Stream stream(74, Purpose::test);
  std::vector<std::unique_ptr<MixedParameters>> parameters;
  for (int lane = 0; lane < lanes; ++lane) {
    parameters.push_back(random_mixed(plain, stream));
    batch->load(lane, *parameters.back());
    expected->load(lane, *parameters.back());
  }
  auto sensors = frame(lanes);
  LaneArray targets(joints, lanes), unchanged(joints, lanes);
  for (int tick = 0; tick < ticks; ++tick) {
    move_randomly(sensors, stream);
    batch->step(sensors, targets);
    expected->step(sensors, unchanged);
    for (int joint = 0; joint < joints; ++joint)
      for (int lane = 0; lane < lanes; ++lane)
        ASSERT_EQ(targets.at(joint, lane), unchanged.at(joint, lane)) << tick << " " << joint;
  }
}

TEST(Mixed, WithoutAJumpAResidualChangesNothing) {
  expect_as_without_seam({.residual_s = 0.03}, 40);
}

TEST(Mixed, AFilterStartsWhereTheTargetIs) {
  expect_as_without_seam({.residual_s = 0.03, .filter_s = 0.02}, 1);
}

/// Leg 1 coupled to leg 0 alone, with strength c.
struct Coupled {
  explicit Coupled(float c, Offset offset = Offset::phase) : mixed(make(offset)) {
    Stream stream(73, Purpose::test);
    parameters = random_mixed(mixed, stream, 0.0);
    parameters->set_offset_ticks(0, 20);
    parameters->set_offset_ticks(1, 45);
    const double ahead = offset == Offset::phase ? 20 - 45 : 45 - 20;
    const double psi = ahead / 100.0;
    for (std::size_t k = 0; k < mixed.net().couplings.size(); ++k)
      if (mixed.net().couplings[k].leg == 1 && mixed.net().couplings[k].other == 0) {
        parameters->in_phase[k] = static_cast<float>(c * std::cos(2.0 * std::numbers::pi * psi));
        parameters->out_of_phase[k] = static_cast<float>(c * std::sin(2.0 * std::numbers::pi * psi));
      }
    batch = mixed.make_batch(1);
    batch->load(0, *parameters);
  }
  static MixedArchitecture make(Offset offset) {
    SupgSettings settings;
    settings.period_s = 1.0;
    settings.idle = Idle::wrap;
    settings.offset = offset;
    return architecture(settings);
  }
  /// How far leg 1 is ahead of leg 0, periods within ± ½, after one more tick.
  double tick(bool touch = false) {
    auto sensors = frame(1);
    sensors.touch.at(1, 0) = touch ? 1.0f : 0.0f;
    LaneArray targets(joints, 1);
    batch->step(sensors, targets);
    std::vector<float> state(batch->state_names().size());
    batch->state(0, state);
    return std::remainder((static_cast<double>(state[1]) - static_cast<double>(state[0])) / 100.0, 1.0);
  }

  MixedArchitecture mixed;
  std::unique_ptr<MixedParameters> parameters;
  std::unique_ptr<Batch> batch;
};

TEST(Mixed, CouplingAloneLocksLegsAtTheDifferenceOfTheirOffsets) {
  for (const Offset offset : {Offset::phase, Offset::delay}) {
    const double locked = offset == Offset::phase ? 0.25 : -0.25;
    Coupled legs_with(0.5f, offset), legs_without(0.0f, offset);
    for (int t = 0; t < 100; ++t) {
      legs_with.tick();
      legs_without.tick();
    }
    // A trigger takes leg 1 away from there.
    EXPECT_GT(std::fabs(legs_with.tick(true) - locked), 0.05);
    legs_without.tick(true);
    for (int t = 0; t < 1500; ++t) {
      legs_with.tick();
      legs_without.tick();
    }
    EXPECT_NEAR(legs_with.tick(), locked, 1e-3);
    EXPECT_GT(std::fabs(legs_without.tick() - locked), 0.05);
  }
}

TEST(Mixed, CoupledPhasesFollowTheClosedFormNearTheLock) {
  // d' = (1/T)(2^(−c sin 2πd) − 1), so that tan πd = tan πd₀ e^(−2π c ln 2 t/T) for small c.
  constexpr float c = 0.02f;
  Coupled coupled(c);
  for (int t = 0; t < 80; ++t) coupled.tick();
  const double before = coupled.tick(true) - 0.25;
  double after = 0.0;
  constexpr int ticks = 1000;
  for (int t = 0; t < ticks; ++t) after = coupled.tick() - 0.25;
  const double shrunk =
      std::exp(-2.0 * std::numbers::pi * static_cast<double>(c) * std::numbers::ln2 * ticks / 100.0);
  EXPECT_NEAR(std::tan(std::numbers::pi * after), std::tan(std::numbers::pi * before) * shrunk,
              0.02 * std::fabs(std::tan(std::numbers::pi * before) * shrunk));
}

TEST(Mixed, ARateThatIsAlwaysThereMakesThePeriodByItsPowerOfTwo) {
  SupgSettings settings;
  settings.period_s = 1.0;
  settings.idle = Idle::wrap;
  settings.trigger = Trigger::none;
  const MixedArchitecture mixed = architecture(settings);
  Stream stream(74, Purpose::test);
  const auto parameters = random_mixed(mixed, stream, 0.0);
  for (const MixedNet::Link& link : mixed.net().rates[2].links)
    if (link.source == 0) parameters->weights[static_cast<std::size_t>(link.index)] = -0.5f;
  const auto batch = mixed.make_batch(1);
  batch->load(0, *parameters);
  auto sensors = frame(1);
  sensors.command.at(1, 0) = 1.0f;
  LaneArray targets(joints, 1);
  std::vector<float> state(batch->state_names().size());
  int wraps = 0;
  float before = -1.0f;
  for (int tick = 0; tick < 10000; ++tick) {
    batch->step(sensors, targets);
    batch->state(0, state);
    wraps += state[2] < before ? 1 : 0;
    before = state[2];
  }
  EXPECT_NEAR(wraps, 10000 / (100 * std::exp2(0.5)), 1.0);
}

TEST(Mixed, TurnsTheOtherWayForAMirroredRobotAndCommand) {
  // Left and right legs change places, and so does what acts on them; sideways numbers change their sign.
  SupgSettings settings = supg_settings();
  const MixedArchitecture mixed = architecture(settings);
  Stream stream(75, Purpose::test);
  const auto one = random_mixed(mixed, stream, 0.0);
  auto other = std::make_unique<MixedParameters>(*one);
  const auto mirrored = [](int supg) { return (supg / types ^ 1) * types + supg % types; };
  for (int supg = 0; supg < joints; ++supg)
    for (std::size_t i = 0; i < mixed.net().amplitudes[static_cast<std::size_t>(supg)].links.size(); ++i) {
      const auto& [source, index] = mixed.net().amplitudes[static_cast<std::size_t>(supg)].links[i];
      const auto& twin = mixed.net().amplitudes[static_cast<std::size_t>(mirrored(supg))].links[i];
      if (source != 0) continue;
      const auto weight = static_cast<float>(stream.uniform(-1.0, 1.0));
      one->weights[static_cast<std::size_t>(index)] = weight;
      other->weights[static_cast<std::size_t>(twin.index)] = -weight;
    }
  for (int leg = 0; leg < legs; ++leg) {
    other->set_offset_ticks(leg ^ 1, one->offset_ticks(leg));
    for (int timer = -1; timer <= period + 1; ++timer)
      for (int type = 0; type < types; ++type)
        other->modulation().entry(leg ^ 1, timer)[type] = one->modulation().entry(leg, timer)[type];
  }
  const auto batch = mixed.make_batch(2);
  batch->load(0, *one);
  batch->load(1, *other);
  auto sensors = frame(2);
  LaneArray targets(joints, 2);
  for (int tick = 0; tick < 50; ++tick) {
    const auto turn = static_cast<float>(stream.uniform(-1.0, 1.0));
    sensors.command.at(1, 0) = turn;
    sensors.command.at(1, 1) = -turn;
    for (int leg = 0; leg < legs; ++leg)
      sensors.touch.at(leg, 0) = sensors.touch.at(leg ^ 1, 1) = stream.chance(0.5) ? 1.0f : 0.0f;
    batch->step(sensors, targets);
    for (int supg = 0; supg < joints; ++supg) ASSERT_EQ(targets.at(supg, 0), targets.at(mirrored(supg), 1));
  }
}

std::string refusal(const std::function<void(substrate::Settings&)>& change, SupgSettings supg = {}) {
  substrate::Settings settings = mixed_substrate();
  change(settings);
  try {
    const MixedArchitecture made(supg, {}, settings, quadruped(), timestep_s);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(Mixed, RefusesLinksThatItsNodesCannotHave) {
  using substrate::Port;
  EXPECT_EQ(refusal([](auto&) {}), "none");
  EXPECT_EQ(refusal([](auto& s) { s.links[0].port = Port::rate; }),
            "controller.substrate.links[0].port = \"rate\": \"n0\" is a neuron: expected hidden");
  EXPECT_EQ(
      refusal([](auto& s) { s.links[4].port = Port::hidden; }),
      "controller.substrate.links[4].port = \"hidden\": \"s0\" is a SUPG: expected rate, amplitude, shift "
      "or coupling");
  EXPECT_EQ(refusal([](auto& s) { s.links.back().port = Port::shift; }),
            "controller.substrate.links[10].port = \"shift\": \"s0\" is a SUPG: expected coupling");
  EXPECT_EQ(refusal([](auto& s) { s.nodes[0].sensor = "sine"; }).substr(0, 55),
            "controller.substrate.nodes: \"command_turn\" is a clock: ");
  EXPECT_EQ(
      refusal([](auto& s) { s.properties[4].of = "lead"; }),
      "controller.substrate.properties[4].of: \"s0\" drives a joint and has no bias: expected pattern or "
      "offset");
  EXPECT_EQ(refusal([](auto& s) { s.properties.back().low = 0.0; }),
            "controller.substrate.properties: a time constant can be 0: expected more than 0");
  EXPECT_EQ(refusal([](auto&) {}, {.modulation = {.sensors = {"pitch"}}}).substr(0, 35),
            "controller.supg.modulation.sensors:");
  EXPECT_EQ(refusal([](auto&) {}, {.modulation = {.sensors = {}, .load_feedback = 1.0}}).substr(0, 41),
            "controller.supg.modulation.load_feedback:");
}

}  // namespace mixed_test
}  // namespace amble::controllers
