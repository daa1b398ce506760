#include "amble/exporting/controller_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/exporting/trace.hpp"
#include "tests/exporting/champions.hpp"

namespace amble::exporting {
namespace {

using controllers::Idle;

TEST(ControllerTables, OfAPhaseAtTheEndOfThePeriodBeginWithWhatFollowsACycle) {
  // Offsets are from 1 tick to one less than the period: with a period of 2 ticks each is 1, the last tick.
  experiment::Champion champion =
      tests::evolve({.name = "",
                     .preset = "authors/supg",
                     .assignments = {"controller.supg.offset=phase", "controller.supg.period_s=0.02"}});
  for (const auto& [idle, first_timer] : {std::pair{Idle::mid, -1}, {Idle::hold, 2}, {Idle::wrap, 0}}) {
    champion.problem.controller.supg.idle = idle;
    const auto tables = std::get<SupgTables>(controller_tables(champion.problem, champion.genome).parts);
    ASSERT_EQ(tables.period_ticks, 2);
    ASSERT_EQ(tables.legs.size(), 4u);
    for (const SupgTables::Leg& leg : tables.legs) {
      EXPECT_EQ(leg.offset_ticks, 1);
      EXPECT_EQ(leg.first_timer, first_timer);
    }
    // A target for each value of the timer, from −1 on.
    for (const auto& targets : tables.targets_rad) EXPECT_EQ(targets.size(), idle == Idle::hold ? 4u : 3u);
  }
}

std::string refusal(const experiment::Champion& champion) {
  try {
    controller_tables(champion.problem, champion.genome);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "none";
}

TEST(ControllerTables, RefuseTriggersByChance) {
  experiment::Champion champion = tests::evolve({.name = "", .preset = "authors/supg"});
  champion.problem.controller.supg.trigger = controllers::Trigger::random;
  EXPECT_EQ(refusal(champion),
            "controller.supg.trigger = \"random\" cannot be exported: it is a control for simulations; "
            "expected \"edge\", \"level\" or \"none\"");
}

TEST(ControllerTables, RefuseSwitching) {
  experiment::Champion switching = tests::evolve({.name = "", .preset = "authors/supg"});
  switching.problem.controller.switching.gaits.resize(2);
  EXPECT_EQ(
      refusal(switching),
      "controller.switching cannot be exported; expected a champion of one genome, as `amble repertoire "
      "RUN --cell` writes");
}

TEST(ControllerTables, OfAWalkerSteeredByHandAreItsOwnAndTheSteering) {
  experiment::Champion champion = tests::evolve({.name = "", .preset = "authors/supg"});
  const ControllerTables walker = controller_tables(champion.problem, champion.genome);
  EXPECT_FALSE(walker.differential || walker.reads_commands());
  champion.problem.set_commands({.kind = trial::CommandKind::fixed, .stretches = {{0.3, 0.0}}});
  champion.problem.set_differential({.turn_gain = 4.0, .full_speed_m_s = 0.25});
  const ControllerTables steered = controller_tables(champion.problem, champion.genome);
  ASSERT_TRUE(steered.differential);
  EXPECT_EQ(steered.differential->turn_gain, 4.0f);
  EXPECT_EQ(steered.differential->full_speed_m_s, 0.25f);
  EXPECT_EQ(steered.differential->joints.size(), 12u);
  EXPECT_TRUE(steered.reads_commands());
  EXPECT_FALSE(steered.reads_heading_error() || steered.reads_attitude());
  EXPECT_EQ(steered.kind, walker.kind);
  EXPECT_EQ(std::get<SupgTables>(steered.parts).targets_rad, std::get<SupgTables>(walker.parts).targets_rad);
  champion.problem.set_differential({.turn_gain = 4.0, .heading_gain = 1.0});
  EXPECT_TRUE(controller_tables(champion.problem, champion.genome).reads_attitude());
}

TEST(ControllerTables, OfCtrnnsReadAndUseEachSensorThatTheirModulesHave) {
  int modules = 0;
  for (const tests::Sample& sample : tests::sensing_samples()) {
    if (!sample.name.starts_with("ctrnn")) continue;
    const experiment::Champion champion = tests::evolve(sample);
    const ControllerTables tables = controller_tables(champion.problem, champion.genome);
    const auto& neural = std::get<NeuralTables>(tables.parts);
    EXPECT_EQ(neural.update, NeuralTables::Update::euler);
    std::vector<int> uses(neural.sensors.size());
    for (const NeuralTables::Neuron& neuron : neural.neurons)
      for (const WeightedLink& link : neuron.from_sensors)
        if (link.weight != 0.0f) ++uses[to_index(link.source)];
    for (const std::string& name : champion.problem.controller.ctrnn.sensors) {
      const std::string kind = name.substr(0, name.find('.'));
      int used = 0;
      for (std::size_t i = 0; i < uses.size(); ++i)
        if (substrate::kind_of(neural.sensors[i].reads).name == kind) used += uses[i];
      EXPECT_GT(used, 0) << sample.name << " " << name << ": replaying it says nothing of this sensor";
      ++modules;
    }
    const bool obeys = sample.name == "ctrnn_obeying";
    EXPECT_TRUE(tables.reads_commands() && tables.reads_touch() && tables.reads_attitude());
    EXPECT_EQ(tables.reads_heading_error(), obeys);
    EXPECT_EQ(tables.reads_yaw_rate(), obeys);
    EXPECT_EQ(
        tables.reads_angles() && tables.reads_speeds() && tables.reads_torques() && tables.reads_loads(),
        !obeys);
  }
  EXPECT_EQ(modules, 13);
}

TEST(ControllerTables, LeaveOutThatASensorIsLate) {
  for (const tests::Sample& sample : tests::sensing_samples()) {
    if (sample.name != "mixed_late") continue;
    experiment::Champion champion = tests::evolve(sample);
    const std::atomic<bool> stop{false};
    const auto targets = [&] {
      std::vector<std::vector<float>> all;
      for (auto& tick : record_trace(champion.problem, champion.genome, 200, stop).ticks)
        all.push_back(std::move(tick.target_rad));
      return all;
    };
    const auto late = targets();
    for (auto& sensor : champion.problem.controller.sensing.sensors)
      sensor.delay_s = sensor.dead_time_s = 0.0;
    EXPECT_EQ(targets(), late) << "test vectors are of readings, not of quantities";
    const auto mixed =
        *std::get<SupgTables>(controller_tables(champion.problem, champion.genome).parts).mixed;
    const auto turn = std::ranges::find(mixed.sensor_names, "command_turn") - mixed.sensor_names.begin();
    ASSERT_LT(turn, std::ssize(mixed.sensors));
    EXPECT_EQ(mixed.sensors[to_index(turn)].gain, 2.0f) << "what the controller multiplies by stays";
  }
}

TEST(ControllerTables, OfOscillatorsNameTheJointsOfLegsAlone) {
  const experiment::Champion champion = tests::evolve({.name = "",
                                                       .preset = "authors/supg",
                                                       .robot = "hexapod",
                                                       .assignments = {"controller.kind=oscillators"}});
  const ControllerTables tables = controller_tables(champion.problem, champion.genome);
  const auto& parts = std::get<OscillatorTables>(tables.parts);
  EXPECT_FALSE(parts.resets);
  EXPECT_TRUE(tables.reads_nothing());
  ASSERT_EQ(parts.oscillators.size(), champion.problem.robot.leg_joint_count());
  for (const OscillatorTables::Oscillator& one : parts.oscillators) {
    EXPECT_GE(one.amplitude_rad, 0.0f);
    EXPECT_LE(2.0f * one.amplitude_rad, one.upper_rad - one.lower_rad);
    EXPECT_GE(tables.joints[static_cast<std::size_t>(one.joint)].leg, 0);
  }
}

}  // namespace
}  // namespace amble::exporting
