#include "amble/controllers/switching.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/controllers/factory.hpp"
#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "tests/controllers/supg_substrate.hpp"
#include "tests/robot/legged.hpp"

namespace amble::controllers {
namespace switching_test {

using testing::HasSubstr;

constexpr double timestep_s = 0.01;
constexpr int legs = 4, joints = 12;

/// A CPPN whose pattern grows with time, and whose offset is the same for all legs.
cppn::Network sloped_cppn(double pattern, double slope, double offset) {
  neat::Genome genome;
  for (std::uint32_t id = 0; id < 6; ++id)
    genome.nodes.push_back({id,
                            id == 0  ? neat::NodeKind::bias
                            : id < 4 ? neat::NodeKind::input
                                     : neat::NodeKind::output,
                            neat::Activation::linear});
  genome.links = {{0, 0, 4, pattern}, {1, 3, 4, slope}, {2, 0, 5, offset}};
  return {genome, {cppn::Linear::identity, true}};
}

struct Gait {
  double speed_m_s, turn_rad_s, pattern, slope, offset;
};

const std::vector<Gait> gaits{
    {0.4, 0.0, -0.2, 0.3, -0.9}, {0.3, 0.5, 0.3, -0.4, -0.6}, {0.1, -0.5, 0.0, 0.2, -0.8}};

/// A walker in one lane, with these gaits; without any its own controller, of the first of `gaits`.
class Walker {
 public:
  explicit Walker(const std::vector<Gait>& some, const SupgSettings& supg = {}, double heading_gain = 0.0)
      : robot_(quadruped()), targets_(joints, 1) {
    ControllerSettings settings;
    settings.supg = supg;
    settings.substrate = supg_substrate();
    architecture_ = make_architecture(settings, robot_, timestep_s);
    const auto decoded = [this](const Gait& gait) {
      return architecture_->decode(sloped_cppn(gait.pattern, gait.slope, gait.offset));
    };
    parameters_ = decoded(gaits.front());
    if (!some.empty()) {
      settings.switching.heading_gain = heading_gain;
      std::vector<std::unique_ptr<Parameters>> all;
      for (const Gait& gait : some) {
        settings.switching.gaits.push_back({gait.speed_m_s, gait.turn_rad_s, "not read here"});
        all.push_back(decoded(gait));
      }
      architecture_ = with_gaits(std::move(architecture_), std::move(all), settings, robot_);
    }
    batch_ = architecture_->make_batch(1);
    batch_->load(0, *parameters_);
    sensors_ = {LaneArray(joints, 1), LaneArray(legs, 1), LaneArray(3, 1)};
    sensors_.command = LaneArray(2, 1);
    sensors_.command_stop = LaneArray(1, 1);
    sensors_.heading_error_rad = LaneArray(1, 1);
    tell(0.4f, 0.0f);
  }

  void tell(float speed_m_s, float turn_rad_s, float heading_error_rad = 0.0f) {
    sensors_.command.at(0, 0) = speed_m_s;
    sensors_.command.at(1, 0) = turn_rad_s;
    sensors_.command_stop.at(0, 0) = speed_m_s == 0.0f && turn_rad_s == 0.0f ? 1.0f : 0.0f;
    sensors_.heading_error_rad.at(0, 0) = heading_error_rad;
  }
  void touch(int leg, bool touches) { sensors_.touch.at(leg, 0) = touches ? 1.0f : 0.0f; }
  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) batch_->step(sensors_, targets_);
  }
  float target_rad(int joint) const { return targets_.at(joint, 0); }
  /// 1 for the first; 0: standing.
  int gait(int leg) const { return static_cast<int>(state("gait.", leg)); }
  int timer(int leg) const { return static_cast<int>(state("timer.", leg)); }
  const robot::RobotSpec& robot() const { return robot_; }
  const Architecture& architecture() const { return *architecture_; }

 private:
  float state(const std::string& what, int leg) const {
    const auto names = batch_->state_names();
    std::vector<float> values(names.size());
    batch_->state(0, values);
    const auto found = std::ranges::find(names, what + robot_.legs[static_cast<std::size_t>(leg)].name);
    return values[static_cast<std::size_t>(found - names.begin())];
  }

  robot::RobotSpec robot_;
  std::unique_ptr<const Architecture> architecture_;
  std::unique_ptr<Parameters> parameters_;
  std::unique_ptr<Batch> batch_;
  robot::SensorFrame sensors_;
  LaneArray targets_;
};

TEST(Switching, WithOneGaitIsThatWalkerToTheBit) {
  for (const Offset offset : {Offset::delay, Offset::phase}) {
    for (const double residual_s : {0.0, 0.05}) {
      SupgSettings supg{.offset = offset};
      supg.seam.residual_s = residual_s;
      Walker plain({}, supg), switching({gaits.front()}, supg);
      Stream stream(1, Purpose::test, 0, 0);
      for (int tick = 0; tick < 1000; ++tick) {
        for (int leg = 0; leg < legs; ++leg) {
          if (stream.below(40) != 0) continue;
          const bool touches = stream.below(2) == 0;
          plain.touch(leg, touches);
          switching.touch(leg, touches);
        }
        const int hundreds = tick / 100;
        if (tick % 100 == 0) switching.tell(0.1f * static_cast<float>(1 + hundreds), 0.3f);
        plain.tick();
        switching.tick();
        for (int joint = 0; joint < joints; ++joint)
          ASSERT_EQ(switching.target_rad(joint), plain.target_rad(joint)) << tick;
      }
    }
  }
}

TEST(Switching, ALegTakesTheWantedGaitAtItsTriggerAndNoOtherLegDoes) {
  Walker walker(gaits, {.idle = Idle::hold});
  walker.tick(60);
  for (int leg = 0; leg < legs; ++leg) ASSERT_EQ(walker.gait(leg), 1);
  walker.tell(0.3f, 0.5f);
  walker.tick(10);
  for (int leg = 0; leg < legs; ++leg) EXPECT_EQ(walker.gait(leg), 1) << "before any trigger";
  walker.touch(2, true);
  walker.tick();
  for (int leg = 0; leg < legs; ++leg) EXPECT_EQ(walker.gait(leg), leg == 2 ? 2 : 1);
}

TEST(Switching, ALegThatIsNotTriggeredTakesItAtTheEndOfItsCycle) {
  Walker walker(gaits, {.idle = Idle::wrap});
  walker.tick(60);
  walker.tell(0.1f, -0.5f);
  int last = walker.timer(0);
  while (true) {
    walker.tick();
    if (walker.timer(0) < last) break;
    EXPECT_EQ(walker.gait(0), 1);
    last = walker.timer(0);
  }
  EXPECT_EQ(walker.gait(0), 3);
}

TEST(Switching, StandsInTheStartPoseWhileAStopIsCommandedAndThenBeginsAsATrialDoes) {
  Walker walker(gaits, {.idle = Idle::wrap}), fresh(gaits, {.idle = Idle::wrap});
  walker.tick(60);
  walker.tell(0.0f, 0.0f);
  walker.tick(120);
  for (int leg = 0; leg < legs; ++leg) EXPECT_EQ(walker.gait(leg), 0);
  for (int joint = 0; joint < joints; ++joint)
    EXPECT_EQ(walker.target_rad(joint),
              held_target_rad(walker.robot().joints[static_cast<std::size_t>(joint)]));
  walker.tell(0.3f, 0.5f);
  fresh.tell(0.3f, 0.5f);
  walker.tick();  // in which it begins
  for (int tick = 0; tick < 150; ++tick) {
    walker.tick();
    fresh.tick();
    for (int joint = 0; joint < joints; ++joint)
      ASSERT_EQ(walker.target_rad(joint), fresh.target_rad(joint)) << tick;
  }
}

TEST(Switching, ToldToStandAtFirstItStandsFromTheFirstTickAlsoWhereTargetsAreSmoothed) {
  SupgSettings smoothed;
  smoothed.seam.filter_s = 0.2;
  Walker walker(gaits, smoothed);
  walker.tell(0.0f, 0.0f);
  for (int tick = 0; tick < 5; ++tick) {
    walker.tick();
    for (int joint = 0; joint < joints; ++joint)
      ASSERT_EQ(walker.target_rad(joint),
                held_target_rad(walker.robot().joints[static_cast<std::size_t>(joint)]))
          << tick;
  }
}

TEST(Switching, AHeadingErrorCountsAsTurnTimesItsGain) {
  Walker without(gaits), with(gaits, {}, 2.0);
  for (Walker* const walker : {&without, &with}) {
    walker->tell(0.3f, 0.0f, 0.25f);
    walker->tick();
  }
  EXPECT_EQ(without.gait(0), 1);
  EXPECT_EQ(with.gait(0), 2);
  EXPECT_FALSE(without.architecture().extra_senses().heading_error);
  EXPECT_TRUE(with.architecture().extra_senses().heading_error);
}

TEST(Switching, ReadsCommandsAndStopsAndHeadingErrorsIfTheyHaveAGain) {
  const Walker without(gaits), with(gaits, {}, 2.0);
  using Kind = substrate::Sensor::Kind;
  for (const Kind kind : {Kind::command_speed, Kind::command_turn, Kind::command_stop})
    EXPECT_TRUE(without.architecture().reads({kind}));
  EXPECT_FALSE(without.architecture().reads({Kind::heading_error}));
  EXPECT_TRUE(with.architecture().reads({Kind::heading_error}));
}

TEST(GaitChoice, IsTheNearestInPartsOfWhatTheGaitsSpanAndOfEquallyNearOnesTheFirst) {
  const GaitChoice choice(
      {.gaits = {{0.1, 0.0, ""}, {0.3, 0.0, ""}, {0.2, 2.0, ""}, {0.2, -2.0, ""}, {0.3, 0.0, ""}}});
  EXPECT_EQ(choice.nearest(0.15f, 0.0f), 0);
  EXPECT_EQ(choice.nearest(0.9f, 0.1f), 1);
  EXPECT_EQ(choice.nearest(0.2f, 1.1f), 2);
  EXPECT_EQ(choice.nearest(0.2f, -1.1f), 3);
  const GaitChoice alike({.gaits = {{0.2, 0.5, ""}, {0.2, 0.1, ""}}});
  EXPECT_EQ(alike.nearest(100.0f, 0.2f), 1) << "all have this speed";
}

TEST(Switching, IsRefusedForOtherControllersAndBesideSteeringByHand) {
  const auto refused = [](ControllerSettings settings) -> std::string {
    settings.substrate = substrate::Settings();
    settings.substrate.layout = substrate::LayoutSource::automatic;
    settings.switching.gaits = {{0.1, 0.0, ""}};
    const robot::RobotSpec robot = tests::legged_robot(2);
    auto made = make_architecture(settings, robot, timestep_s);
    try {
      with_gaits(std::move(made), {}, settings, robot);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  ControllerSettings ctrnn, steered;
  ctrnn.kind = "ctrnn";
  steered.differential.turn_gain = 1.0;
  EXPECT_THAT(refused(ctrnn), HasSubstr("controllers of kind ctrnn cannot switch gaits"));
  EXPECT_THAT(refused(steered), HasSubstr("both steer"));
}

}  // namespace switching_test
}  // namespace amble::controllers
