#include "amble/trial/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "amble/morphology/robot_file.hpp"
#include "tests/trial/fakes.hpp"

namespace amble::trial {
namespace {

const std::atomic<bool> never{false};

Protocol protocol(int steps, double fall_height_m = 0.0, record::PathSampling path = {}) {
  Protocol protocol;
  protocol.steps = steps;
  protocol.path = path;
  protocol.fall.below_m = fall_height_m;
  return protocol;
}

/// A start, and nothing else.
Scenario start_at(Vec3 position_m, Quat rotation = {}) {
  Scenario scenario;
  scenario.start = physics::StartPose{.root = {position_m, rotation}, .joint_angle_rad = {0.0}};
  scenario.joint_sensor_rad = {0.0f};
  scenario.attitude_sensor_rad = {0.0f, 0.0f, 0.0f};
  return scenario;
}

/// A start, a push and a latency.
Scenario some_scenario() {
  Scenario scenario = start_at({7.0, 0.0, 2.0});
  scenario.pushes = {{.step = 3, .impulse_n_s = {100.0, 0.0, 0.0}}};
  scenario.latency_ticks = 2;
  return scenario;
}

TEST(Runner, StopsACompletedTrialAfterItsLastStep) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(0.5f)});
  Runner(engine, batch, protocol(7)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::completed);
  EXPECT_EQ(trajectory.steps, 7);
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 3.5);
  EXPECT_EQ(engine.steps, 7);
}

TEST(Runner, EndsATrialInTheStepThatBringsTheRootBelowTheFallHeight) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f)});
  Runner(engine, batch, protocol(100, 0.9895)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::fell);
  EXPECT_EQ(trajectory.steps, 11);  // 1 − 11 mm is the first height below 0.9895 m
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 11.0);
}

TEST(Runner, EndsATrialWhoseRootIsTooHighOrTiltedTooFar) {
  const auto steps_of = [](robot::FallRule fall, double roll_rad) {
    FakeEngine engine(1);
    FakeBatch batch(1);
    Protocol how = protocol(100);
    how.fall = fall;
    // The fake robot keeps its rotation: the start pose is what it is tilted from.
    how.start_rotation = axis_angle({1.0, 0.0, 0.0}, roll_rad);
    Queue queue({FakeParameters(1.0f)});
    Runner(engine, batch, how).run(queue, never);
    return queue.results[0]->outcome == record::Outcome::fell ? queue.results[0]->steps : 0;
  };
  EXPECT_EQ(steps_of({.below_m = 0.0, .above_m = 0.9985}, 0.0), 1);
  EXPECT_EQ(steps_of({.below_m = 0.0, .above_m = 0.9995}, 0.0), 0) << "it sinks by 1 mm a step";
  EXPECT_EQ(steps_of({.below_m = 0.0, .tilt_rad = 0.2}, 0.21), 1);
  EXPECT_EQ(steps_of({.below_m = 0.0, .tilt_rad = 0.2}, -0.21), 1);
  EXPECT_EQ(steps_of({.below_m = 0.0, .tilt_rad = 0.2}, 0.19), 0);
}

TEST(Runner, MeasuresHowFarTheRootsFrameMoved) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Protocol how = protocol(7);
  how.measures.root = true;
  Queue queue({FakeParameters(0.5f)});
  Runner(engine, batch, how).run(queue, never);
  EXPECT_EQ(queue.results[0]->root_start_m.x, 0.0);
  EXPECT_DOUBLE_EQ(queue.results[0]->root_end_m.x, 3.5);
  EXPECT_NEAR(queue.results[0]->root_end_m.z, 0.993, 1e-12);
}

TEST(Runner, CallsAFallInTheLastStepAFall) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f)});
  Runner(engine, batch, protocol(11, 0.9895)).run(queue, never);
  EXPECT_EQ(queue.results[0]->outcome, record::Outcome::fell);
  EXPECT_EQ(queue.results[0]->steps, 11);
}

TEST(Runner, LetsATrialGoOnWhoseRootIsAtTheFallHeightItself) {
  double height_m = 1.0;  // after five steps, to the bit
  for (int step = 0; step < 5; ++step) height_m -= 0.001;
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f)});
  Runner(engine, batch, protocol(100, height_m)).run(queue, never);
  EXPECT_EQ(queue.results[0]->outcome, record::Outcome::fell);
  EXPECT_EQ(queue.results[0]->steps, 6) << "the first that brings it below";
}

TEST(Runner, KeepsTheLastHealthyPositionOfATrialThatDiverges) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f, 4)});
  Runner(engine, batch, protocol(100)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::diverged);
  EXPECT_EQ(trajectory.steps, 5);
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 4.0);
}

TEST(Runner, KeepsTheDirectionOfTheStartForATrialThatDiverges) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  const auto to_the_left = start_at({0.0, 0.0, 2.0}, {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)});
  Queue queue({FakeParameters(1.0f, 4)}, &to_the_left);
  Runner(engine, batch, protocol(100)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  ASSERT_EQ(trajectory.outcome, record::Outcome::diverged);
  EXPECT_NEAR(trajectory.forward_y, 1.0, 1e-12);
  EXPECT_EQ(trajectory.forward_end_x, trajectory.forward_x);
  EXPECT_EQ(trajectory.forward_end_y, trajectory.forward_y);
}

TEST(Runner, SamplesThePathOnceInEachStrideRelativeToTheStart) {
  for (const int first_step : {1, 2, 3}) {
    FakeEngine engine(1);
    FakeBatch batch(1);
    Queue queue({FakeParameters(0.25f)});
    Runner(engine, batch, protocol(7, 0.0, {.stride = 3, .first_step = first_step})).run(queue, never);
    const float x = 0.25f * static_cast<float>(first_step);
    EXPECT_EQ(queue.results[0]->com_path_m, (std::vector<float>{x, 0.0f, x + 0.75f, 0.0f})) << first_step;
  }
}

TEST(Runner, NotesTheCentreOfMassAfterEachWholeSecondRelativeToTheStartIfAsked) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  const auto displaced = start_at({7.0, 3.0, 2.0});
  for (const bool asked : {false, true}) {
    Protocol seconds = protocol(250);
    seconds.measures.seconds = asked;
    Queue queue({FakeParameters(0.25f)}, &displaced);
    Runner(engine, batch, seconds).run(queue, never);
    EXPECT_EQ(queue.results[0]->com_by_second_m,
              asked ? std::vector<double>({25.0, 0.0, 50.0, 0.0}) : std::vector<double>());
  }
}

TEST(Runner, CountsTheStepsInWhichEachFootIsDownIfAsked) {
  for (const bool asked : {true, false}) {
    FakeEngine engine(1);
    engine.foot_down_from = 8;
    FakeBatch batch(1);
    Queue queue({FakeParameters(0.5f)});
    Protocol contacts = protocol(20);
    contacts.measures.contacts = asked;
    Runner(engine, batch, contacts).run(queue, never);
    EXPECT_EQ(queue.results[0]->contact_steps, asked ? std::vector<int>{13} : std::vector<int>());
  }
}

TEST(Runner, NotesWhichWayTheRobotFacesAtTheStartAndThatItIsUpright) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  constexpr double yaw_rad = 0.5;
  const Quat yaw = axis_angle({0.0, 0.0, 1.0}, yaw_rad);
  const Quat leaning = axis_angle({0.6, 0.8, 0.0}, 0.7);
  Scenario turned;
  turned.start = physics::StartPose{.root = {{0.0, 0.0, 1.0}, yaw}, .joint_angle_rad = {}};
  turned.joint_sensor_rad = {0.0f};
  turned.attitude_sensor_rad = {0.0f, 0.0f, 0.0f};
  for (const Quat own : {Quat(), leaning}) {
    // A robot whose root has this rotation in its own start pose faces +x then.
    Protocol facing = protocol(3);
    facing.start_rotation = own;
    facing.measures.uprightness = true;
    turned.start->root.rotation = yaw * own;
    OneTask task(std::make_shared<FakeParameters>(0.25f), nullptr, &turned);
    Runner(engine, batch, facing).run(task, never);
    EXPECT_NEAR(task.result()->forward_x, std::cos(yaw_rad), 1e-12);
    EXPECT_NEAR(task.result()->forward_y, std::sin(yaw_rad), 1e-12);
    EXPECT_NEAR(task.result()->upright_steps, 3.0, 1e-12);
  }
}

Protocol after_first_step(int steps) {
  Protocol late = protocol(steps, 0.0, {.stride = 1});
  late.first_command = FirstCommand::after_first_step;
  return late;
}

TEST(Runner, HoldsTheJointsInTheFirstStepIfControllersActAfterIt) {
  FakeEngine engine(1);
  engine.start_angle_rad = 0.125f;
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f), FakeParameters(2.0f)});
  Runner(engine, batch, after_first_step(3)).run(queue, never);
  EXPECT_EQ(queue.results[0]->com_path_m, (std::vector<float>{0.125f, 0.0f, 1.125f, 0.0f, 2.125f, 0.0f}));
  EXPECT_EQ(queue.results[1]->com_path_m, (std::vector<float>{0.125f, 0.0f, 2.125f, 0.0f, 4.125f, 0.0f}));
}

TEST(Runner, BeginsControllersWithTheirFirstCommand) {
  for (const auto first : {FirstCommand::before_first_step, FirstCommand::after_first_step}) {
    FakeEngine engine(1);
    FakeBatch batch(1);
    Queue queue({FakeParameters(1.0f, 4)});
    Protocol late = protocol(100);
    late.first_command = first;
    Runner(engine, batch, late).run(queue, never);
    EXPECT_EQ(queue.results[0]->outcome, record::Outcome::diverged);
    EXPECT_EQ(queue.results[0]->steps, first == FirstCommand::before_first_step ? 5 : 6);
  }
}

TEST(Runner, GivesTrialsThatBeginLateTheSameResultForAnyNumberOfLanes) {
  std::vector<FakeParameters> tasks;
  for (int i = 0; i < 37; ++i) tasks.emplace_back(0.125f * static_cast<float>(i), 1 + (i * 7) % 19);
  std::vector<std::vector<double>> ends;
  for (const int lanes : {1, 2, 8, 64}) {
    FakeEngine engine(lanes);
    engine.start_angle_rad = 0.5f;
    FakeBatch batch(lanes);
    Queue queue(tasks);
    Runner(engine, batch, after_first_step(12)).run(queue, never);
    ends.emplace_back();
    for (const auto& result : queue.results) ends.back().push_back(result.value().com_end_m.x);
  }
  for (const auto& other : ends) EXPECT_EQ(other, ends.front());
}

TEST(Runner, RefillsALaneInTheStepAfterItsTrialEnded) {
  // Two lanes, trials of 2 and 8 steps in turn: lane 0 runs four short ones while lane 1 runs a long one.
  FakeEngine engine(2);
  FakeBatch batch(2);
  const FakeParameters diverges_at_2(1.0f, 1), lasts(1.0f);
  Queue queue({diverges_at_2, lasts, diverges_at_2, diverges_at_2, diverges_at_2});
  Runner runner(engine, batch, protocol(8));
  runner.run(queue, never);
  EXPECT_EQ(engine.steps, 8);
  EXPECT_EQ(engine.moved, 16);
  EXPECT_EQ(runner.steps_simulated(), 16u);
}

TEST(Runner, GivesEveryTrialTheSameResultForAnyNumberOfLanes) {
  std::vector<FakeParameters> tasks;
  for (int i = 0; i < 37; ++i) tasks.emplace_back(0.125f * static_cast<float>(i), 1 + (i * 7) % 19);
  std::vector<std::vector<double>> ends;
  for (const int lanes : {1, 2, 8, 16, 64}) {
    FakeEngine engine(lanes);
    FakeBatch batch(lanes);
    Queue queue(tasks);
    Runner(engine, batch, protocol(12)).run(queue, never);
    ends.emplace_back();
    for (const auto& result : queue.results) ends.back().push_back(result.value().com_end_m.x);
  }
  for (const auto& other : ends) EXPECT_EQ(other, ends.front());
}

TEST(Runner, LetsAScenarioActOnItsTrial) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  const auto scenario = some_scenario();
  Queue queue({FakeParameters(1.0f)}, &scenario);
  Runner(engine, batch, protocol(10, 0.0, {.stride = 1})).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.com_start_m, (Vec3{7.0, 0.0, 2.0}));
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 7.0 + 8.0 + 100.0) << "the targets of 10 steps, two of them late";
  EXPECT_EQ(trajectory.com_path_m[2], 0.0f) << "before the push and the first target";
  EXPECT_EQ(trajectory.com_path_m[4], 101.0f) << "both in step 3";
}

TEST(Runner, GivesEveryDisturbedTrialTheSameResultForAnyNumberOfLanes) {
  const auto scenario = some_scenario();
  std::vector<FakeParameters> tasks;
  for (int i = 0; i < 37; ++i) tasks.emplace_back(0.125f * static_cast<float>(i), 1 + (i * 7) % 19);
  std::vector<std::vector<double>> ends;
  for (const int lanes : {1, 2, 8, 64}) {
    FakeEngine engine(lanes);
    FakeBatch batch(lanes);
    Queue queue(tasks, &scenario);
    Runner(engine, batch, protocol(12)).run(queue, never);
    ends.emplace_back();
    for (const auto& result : queue.results) ends.back().push_back(result.value().com_end_m.x);
  }
  for (const auto& other : ends) EXPECT_EQ(other, ends.front());
}

TEST(Runner, ForgetsTheScenarioOfATrialWhenTheNextHasNone) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Runner runner(engine, batch, protocol(5));
  const auto scenario = some_scenario();
  Queue disturbed({FakeParameters(1.0f)}, &scenario), undisturbed({FakeParameters(1.0f)});
  runner.run(disturbed, never);
  runner.run(undisturbed, never);
  EXPECT_DOUBLE_EQ(undisturbed.results[0]->com_end_m.x, 5.0);
  EXPECT_EQ(runner.steps_simulated(), 10u);
}

TEST(Runner, StartsAfreshAfterItWasStopped) {
  FakeEngine engine(2);
  FakeBatch batch(2);
  Runner runner(engine, batch, protocol(5));
  Queue dropped({FakeParameters(1.0f), FakeParameters(1.0f)});
  const std::atomic<bool> stop{true};
  runner.run(dropped, stop);
  Queue queue({FakeParameters(1.0f)});
  runner.run(queue, never);
  EXPECT_DOUBLE_EQ(queue.results[0]->com_end_m.x, 5.0);
  EXPECT_FALSE(dropped.results[0]);
}

TEST(Runner, DoesNothingWithAnEmptyQueue) {
  FakeEngine engine(4);
  FakeBatch batch(4);
  Queue queue({});
  Runner(engine, batch, protocol(8)).run(queue, never);
  EXPECT_EQ(engine.steps, 0);
}

TEST(Runner, DropsTrialsInFlightWhenItIsStopped) {
  class StopAt : public Observer {
   public:
    explicit StopAt(std::atomic<bool>& stop) : stop_(stop) {}
    void on_step(int step, const physics::Engine&, const controllers::Batch&, const LaneArray&,
                 int) override {
      if (step == 3) stop_ = true;
    }

   private:
    std::atomic<bool>& stop_;
  };
  std::atomic<bool> stop{false};
  StopAt observer(stop);
  FakeEngine engine(1);
  FakeBatch batch(1);
  OneTask task(std::make_unique<FakeParameters>(1.0f), &observer);
  Runner(engine, batch, protocol(100)).run(task, stop);
  EXPECT_FALSE(task.result());
  EXPECT_EQ(engine.steps, 3);
}

TEST(Runner, MeasuresTheFallHeightFromTheGroundBelowTheRoot) {
  // The point sinks by 1 mm a step from 1 m and walks 4 cm a step, over a staircase of 10 cm every 0.4 m.
  ground::HeightField field(0.04);
  for (int j = 0; j < 256; ++j)
    for (int i = 0; i < 128; ++i) field.node(i, j) = 0.1f * static_cast<float>(i / 10);
  const auto ground = std::make_shared<const ground::Ground>(
      field, morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml"));
  for (const double fall_height_m : {0.35, 0.55, 0.75, 0.95}) {
    FakeEngine engine(1);
    engine.set_ground(ground);
    FakeBatch batch(1);
    Queue queue({FakeParameters(0.04f)});
    Runner(engine, batch, protocol(1000, fall_height_m)).run(queue, never);
    const auto& trajectory = queue.results[0].value();
    EXPECT_EQ(trajectory.outcome, record::Outcome::fell);
    int steps = 1;
    while (1.0 - 0.001 * steps - ground->height_m(static_cast<double>(0.04f) * steps, 0.0) >= fall_height_m)
      ++steps;
    EXPECT_NEAR(trajectory.steps, steps, 1) << fall_height_m;
    EXPECT_LT(trajectory.steps, 70);
  }
}

TEST(Runner, NotesHeadingsAndCommandsSecondBySecond) {
  FakeEngine engine(1);
  FakeBatch controllers(1);
  Protocol protocol;
  protocol.steps = 250;
  protocol.measures = {.headings = true, .commands = true};
  protocol.commands = CommandSchedule({{0, {0.4f, 0.0f}}, {150, {0.2f, -0.5f}}}, 0);
  Runner runner(engine, controllers, protocol);
  Queue queue({FakeParameters(0.001f)});
  const std::atomic<bool> stop{false};
  runner.run(queue, stop);
  const record::Trajectory& trajectory = *queue.results[0];
  ASSERT_EQ(trajectory.turned_by_second_rad.size(), 2u);
  ASSERT_EQ(trajectory.command_by_second.size(), 4u);
  EXPECT_NEAR(trajectory.command_by_second[0], 0.4, 1e-6);
  EXPECT_NEAR(trajectory.command_by_second[2], 0.3, 1e-6);
  EXPECT_NEAR(trajectory.command_by_second[3], -0.25, 1e-6);
  EXPECT_EQ(trajectory.turned_rad, 0.0);
}

TEST(Runner, NotesCommandsThatAFallKeptFromComing) {
  // The point sinks by 1 mm a step from 1 m: it falls in its second second.
  FakeEngine engine(1);
  FakeBatch controllers(1);
  Protocol falling = protocol(450, 0.87);
  falling.measures = {.headings = true, .commands = true};
  falling.commands = CommandSchedule({{0, {0.4f, 0.0f}}, {250, {0.2f, -0.5f}}}, 0);
  Queue queue({FakeParameters(0.001f)});
  const std::atomic<bool> stop{false};
  Runner(engine, controllers, falling).run(queue, stop);
  const record::Trajectory& trajectory = *queue.results[0];
  ASSERT_EQ(trajectory.outcome, record::Outcome::fell);
  ASSERT_EQ(trajectory.turned_by_second_rad.size(), 1u);
  ASSERT_EQ(trajectory.command_by_second.size(), 8u) << "of all whole seconds";
  EXPECT_NEAR(trajectory.command_by_second[2], 0.4, 1e-6) << "the second that the fall is in";
  EXPECT_NEAR(trajectory.command_by_second[4], 0.2, 1e-6) << "as at its end";
  EXPECT_NEAR(trajectory.command_by_second[7], -0.5, 1e-6);
}

TEST(Runner, ObeysTheScenariosCommandsBeforeTheProtocols) {
  FakeEngine engine(1);
  FakeBatch controllers(1);
  Protocol protocol;
  protocol.steps = 100;
  protocol.measures = {.commands = true};
  protocol.commands = CommandSchedule({{0, {0.4f, 0.0f}}}, 0);
  Scenario scenario;
  scenario.joint_sensor_rad = {0.0f};
  scenario.attitude_sensor_rad = {0.0f, 0.0f, 0.0f};
  scenario.commands = CommandSchedule({{0, {0.0f, 1.0f}}}, 0);
  Runner runner(engine, controllers, protocol);
  Queue queue({FakeParameters(0.001f)}, &scenario);
  const std::atomic<bool> stop{false};
  runner.run(queue, stop);
  EXPECT_NEAR(queue.results[0]->command_by_second[1], 1.0, 1e-6);
}

}  // namespace
}  // namespace amble::trial
