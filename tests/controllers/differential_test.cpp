#include "amble/controllers/differential.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/controllers/factory.hpp"
#include "amble/controllers/joint_range.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/robot/legged.hpp"

namespace amble::controllers {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double step_s = 0.01;
constexpr int knee = 0, hip_fb = 1, hip_io = 2, types = 3;

ControllerSettings walker(const DifferentialSettings& steering = {}) {
  ControllerSettings settings;
  settings.kind = "oscillators";
  settings.differential = steering;
  return settings;
}

/// The same walk on both sides: frequency, then amplitude, phase and offset of each joint, those of a pair of
/// legs alike.
std::vector<double> gait(int legs) {
  std::vector<double> outputs{0.1, 0.1};
  Stream stream(1, Purpose::test, 0, 0);
  for (int pair = 0; pair < legs / 2; ++pair) {
    std::vector<double> of_leg;
    for (int i = 0; i < 3 * types; ++i) of_leg.push_back(stream.uniform(-0.9, 0.9));
    for (int side = 0; side < 2; ++side) outputs.insert(outputs.end(), of_leg.begin(), of_leg.end());
  }
  return outputs;
}

/// Walkers of one robot in several lanes, all of one gait, each told something else.
class Walkers {
 public:
  explicit Walkers(const DifferentialSettings& steering, int lanes = 1, int rows = 2)
      : robot_(tests::legged_robot(rows)),
        architecture_(make_architecture(walker(steering), robot_, step_s)),
        batch_(architecture_->make_batch(lanes)),
        parameters_(architecture_->decode(constant_cppn(0, gait(2 * rows)))),
        sensors_{LaneArray(joints(), lanes), LaneArray(2 * rows, lanes), LaneArray(3, lanes)},
        targets_(joints(), lanes) {
    sensors_.command = LaneArray(2, lanes);
    sensors_.command_stop = LaneArray(1, lanes);
    sensors_.heading_error_rad = LaneArray(1, lanes);
    for (int lane = 0; lane < lanes; ++lane) batch_->load(lane, *parameters_);
  }

  int joints() const { return static_cast<int>(robot_.joints.size()); }
  void tell(int lane, float speed_m_s, float turn_rad_s, float heading_error_rad = 0.0f) {
    sensors_.command.at(0, lane) = speed_m_s;
    sensors_.command.at(1, lane) = turn_rad_s;
    sensors_.command_stop.at(0, lane) = speed_m_s == 0.0f && turn_rad_s == 0.0f ? 1.0f : 0.0f;
    sensors_.heading_error_rad.at(0, lane) = heading_error_rad;
  }
  void tick() { batch_->step(sensors_, targets_); }
  float target_rad(int leg, int type, int lane = 0) const { return targets_.at(leg * types + type, lane); }
  const robot::RobotSpec& robot() const { return robot_; }
  Batch& batch() { return *batch_; }
  const Architecture& architecture() const { return *architecture_; }

 private:
  robot::RobotSpec robot_;
  std::unique_ptr<const Architecture> architecture_;
  std::unique_ptr<Batch> batch_;
  std::unique_ptr<Parameters> parameters_;
  robot::SensorFrame sensors_;
  LaneArray targets_;
};

const DifferentialSettings at_once{.turn_gain = 2.0, .full_speed_m_s = 0.4, .change_s = 0.0};

TEST(Differential, IsOffByDefaultAndThenIsNotThere) {
  const auto robot = tests::legged_robot(2);
  const auto plain = make_architecture(walker(), robot, step_s);
  EXPECT_EQ(dynamic_cast<const DifferentialArchitecture*>(plain.get()), nullptr);
  EXPECT_FALSE(plain->extra_senses().commands());
  EXPECT_TRUE(make_architecture(walker(at_once), robot, step_s)->extra_senses().command);
}

TEST(Differential, StraightAheadAtFullSpeedGivesTheBitsOfTheWalkerWithoutIt) {
  Walkers plain({}), steered({.turn_gain = 2.0, .full_speed_m_s = 0.4, .heading_gain = 1.0});
  steered.tell(0, 0.4f, 0.0f);
  for (int tick = 0; tick < 300; ++tick) {
    plain.tick();
    steered.tick();
    for (int leg = 0; leg < 4; ++leg)
      for (int type = 0; type < types; ++type)
        ASSERT_EQ(steered.target_rad(leg, type), plain.target_rad(leg, type)) << tick;
  }
}

TEST(Differential, SwingsTheInnerLegsByOneMinusGainTimesTurnAboutTheStartPose) {
  Walkers plain({}), steered(at_once);
  steered.tell(0, 0.4f, 0.25f);  // to the left: the left legs, 0 and 2, by a half
  for (int tick = 0; tick < 300; ++tick) {
    plain.tick();
    steered.tick();
    for (int leg = 0; leg < 4; ++leg) {
      const float factor = leg % 2 == 0 ? 0.5f : 1.0f;
      ASSERT_FLOAT_EQ(steered.target_rad(leg, hip_fb), factor * plain.target_rad(leg, hip_fb));
      ASSERT_EQ(steered.target_rad(leg, knee), plain.target_rad(leg, knee));
      ASSERT_EQ(steered.target_rad(leg, hip_io), plain.target_rad(leg, hip_io));
    }
  }
}

TEST(Differential, BackwardsSwingsTheOtherLegsLessForTheSameTurn) {
  Walkers plain({}), steered(at_once);
  steered.tell(0, -0.4f, 0.25f);  // to the left: the right legs, 1 and 3, by a half, and all backwards
  for (int tick = 0; tick < 300; ++tick) {
    plain.tick();
    steered.tick();
    for (int leg = 0; leg < 4; ++leg)
      EXPECT_NEAR(steered.target_rad(leg, hip_fb),
                  (leg % 2 == 0 ? -1.0f : -0.5f) * plain.target_rad(leg, hip_fb), 1e-6)
          << tick;
  }
}

TEST(Differential, OfGainTimesTurnOneStopsTheInnerSideAndOfTwoItSwingsBackwards) {
  Walkers plain({}), stops(at_once), backs(at_once), more(at_once);
  stops.tell(0, 0.4f, -0.5f);
  backs.tell(0, 0.4f, -1.0f);
  more.tell(0, 0.4f, -5.0f);
  for (int tick = 0; tick < 300; ++tick) {
    for (Walkers* const walkers : {&plain, &stops, &backs, &more}) walkers->tick();
    for (const int right : {1, 3}) {
      ASSERT_EQ(stops.target_rad(right, hip_fb), 0.0f);
      ASSERT_FLOAT_EQ(backs.target_rad(right, hip_fb), -plain.target_rad(right, hip_fb));
      ASSERT_EQ(more.target_rad(right, hip_fb), backs.target_rad(right, hip_fb));
      ASSERT_EQ(stops.target_rad(right - 1, hip_fb), plain.target_rad(right - 1, hip_fb));
    }
  }
}

TEST(Differential, MirroredCommandsGiveASymmetricWalkerMirroredTargets) {
  const DifferentialSettings settings{
      .turn_gain = 1.7, .full_speed_m_s = 0.4, .heading_gain = 0.9, .change_s = 0.13};
  Walkers walkers(settings, 2, 3);
  Stream stream(2, Purpose::test, 0, 0);
  for (int tick = 0; tick < 600; ++tick) {
    if (tick % 40 == 0) {
      const auto speed = static_cast<float>(stream.uniform(-0.1, 0.5)),
                 turn = static_cast<float>(stream.uniform(-0.6, 0.6)),
                 error = static_cast<float>(stream.uniform(-1.0, 1.0));
      walkers.tell(0, speed, turn, error);
      walkers.tell(1, speed, -turn, -error);
    }
    walkers.tick();
    for (int leg = 0; leg < 6; ++leg)
      for (int type = 0; type < types; ++type)
        ASSERT_EQ(walkers.target_rad(leg, type, 0), walkers.target_rad(leg ^ 1, type, 1)) << tick;
  }
}

TEST(Differential, SlowerCommandsSwingLegsByTheirShareOfTheFullSpeedAndFasterOnesNoFarther) {
  Walkers plain({}), slow(at_once), fast(at_once);
  slow.tell(0, 0.1f, 0.0f);
  fast.tell(0, 2.0f, 0.0f);
  for (int tick = 0; tick < 200; ++tick) {
    for (Walkers* const walkers : {&plain, &slow, &fast}) walkers->tick();
    ASSERT_FLOAT_EQ(slow.target_rad(0, hip_fb), 0.25f * plain.target_rad(0, hip_fb));
    ASSERT_EQ(slow.target_rad(0, knee), plain.target_rad(0, knee));
    ASSERT_EQ(fast.target_rad(0, hip_fb), plain.target_rad(0, hip_fb));
  }
}

TEST(Differential, AStopBringsAllJointsToTheStartPoseWithinItsTimeAndSmoothly) {
  Walkers plain({}), stops({.turn_gain = 2.0, .full_speed_m_s = 0.4, .change_s = 0.5});
  stops.tell(0, 0.4f, 0.0f);
  plain.tick(), stops.tick();
  stops.tell(0, 0.0f, 0.0f);
  for (int tick = 1; tick <= 100; ++tick) {
    plain.tick();
    stops.tick();
    const float left = std::max(0.0f, 1.0f - 0.02f * static_cast<float>(tick));
    for (int leg = 0; leg < 4; ++leg)
      for (int type = 0; type < types; ++type)
        ASSERT_NEAR(stops.target_rad(leg, type), left * plain.target_rad(leg, type), 1e-5) << tick;
  }
  EXPECT_EQ(stops.target_rad(0, knee), 0.0f);
}

TEST(Differential, ATurnOfTheHeadingErrorIsAddedToTheCommandedOne) {
  Walkers by_turn(at_once),
      by_error({.turn_gain = 2.0, .full_speed_m_s = 0.4, .heading_gain = 0.5, .change_s = 0.0});
  by_turn.tell(0, 0.4f, 0.2f);
  by_error.tell(0, 0.4f, 0.1f, 0.2f);
  for (int tick = 0; tick < 100; ++tick) {
    by_turn.tick();
    by_error.tick();
    for (int leg = 0; leg < 4; ++leg)
      ASSERT_FLOAT_EQ(by_error.target_rad(leg, hip_fb), by_turn.target_rad(leg, hip_fb));
  }
  EXPECT_TRUE(by_error.architecture().extra_senses().heading_error);
  EXPECT_FALSE(by_turn.architecture().extra_senses().heading_error);
}

TEST(Differential, AboutTheMiddleOfTheRangeAStopLeavesEachJointThere) {
  Walkers stops({.full_speed_m_s = 0.4, .change_s = 0.0, .about = SwingCentre::middle});
  stops.tell(0, 0.0f, 0.0f);
  stops.tick();
  const auto ranges = joint_ranges(stops.robot());
  for (int leg = 0; leg < 4; ++leg)
    for (int type = 0; type < types; ++type)
      EXPECT_EQ(stops.target_rad(leg, type), ranges[to_index(leg * types + type)].at(0.5));
}

TEST(Differential, BeginsATrialWithWhatTheFirstTickAsksForWhateverTheLaneDidBefore) {
  Walkers first(at_once), again({.turn_gain = 2.0, .full_speed_m_s = 0.4, .change_s = 10.0});
  const auto parameters = again.architecture().decode(constant_cppn(0, gait(4)));
  again.tell(0, 0.4f, -0.4f);
  for (int tick = 0; tick < 50; ++tick) again.tick();
  again.batch().load(0, *parameters);
  first.tell(0, 0.2f, 0.3f);
  again.tell(0, 0.2f, 0.3f);
  first.tick();
  again.tick();
  for (int leg = 0; leg < 4; ++leg) EXPECT_EQ(again.target_rad(leg, hip_fb), first.target_rad(leg, hip_fb));
}

TEST(Differential, RecordsWhatItMultipliesBy) {
  Walkers steered(at_once);
  steered.tell(0, 0.2f, 0.25f);
  steered.tick();
  std::vector<float> values(steered.batch().state_names().size());
  steered.batch().state(0, values);
  EXPECT_EQ(steered.batch().state_names().back(), "swing.others");
  EXPECT_THAT(std::vector<float>(values.end() - 4, values.end()), ElementsAre(0.25f, 0.5f, 0.5f, 1.0f));
}

TEST(SwingJoints, AreThoseThatMoveAFootFarthestForwardAndSidesThoseOfTheHips) {
  const auto legged = swing_joints(tests::legged_robot(3), {});
  for (int leg = 0; leg < 6; ++leg)
    EXPECT_THAT(legged.of_legs[to_index(leg)], ElementsAre(leg * types + hip_fb));
  EXPECT_THAT(legged.sides, ElementsAre(1, -1, 1, -1, 1, -1));
  const auto both = swing_joints(tests::legged_robot(1), {"knee", "hip_fb"});
  EXPECT_THAT(both.of_legs[1], ElementsAre(3, 4));
}

TEST(SwingJoints, LeaveOutWhatIsHeld) {
  const auto robot = tests::with_held_joint(tests::legged_robot(2), 1, hip_fb);
  EXPECT_THAT(swing_joints(robot, {}).of_legs[1], ElementsAre(3)) << "the knee is what is left";
}

/// The message of what is refused.
std::string refusal(const ControllerSettings& settings, const robot::RobotSpec& robot) {
  try {
    make_architecture(settings, robot, step_s);
  } catch (const SettingError& error) {
    return error.what();
  }
  return {};
}

TEST(Differential, RefusesWhatHasNoEffectOrIsNotThere) {
  const auto legged = tests::legged_robot(2);
  auto one_legged = tests::legged_robot(1);
  one_legged.legs.pop_back();
  EXPECT_THAT(refusal(walker({.heading_gain = 1.0}), legged), HasSubstr("without a turn_gain nothing turns"));
  EXPECT_THAT(
      refusal(walker({.turn_gain = 1.0, .joint_types = {"toe"}}), legged),
      HasSubstr("joint_types[0] = \"toe\": the robot has no joint type toe; expected knee, hip_fb, hip_io"));
  EXPECT_THAT(refusal(walker({.turn_gain = 1.0}), one_legged), HasSubstr("no left and right legs"));
  auto tracking = walker({.turn_gain = 1.0});
  tracking.kind = "supg";
  tracking.substrate.layout = substrate::LayoutSource::automatic;
  tracking.supg.contact.source = ContactSource::tracking;
  EXPECT_THAT(refusal(tracking, legged), HasSubstr("contacts are guessed from targets"));
}

}  // namespace
}  // namespace amble::controllers
