#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/io/file.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/pose.hpp"
#include "tests/experiment/fixture.hpp"

// Runs whose score is not the distance.
namespace amble::experiment {
namespace scored_run_test {

const std::atomic<bool> never{false};

/// The slow twin of what a trial measures: from the engine's own state after each step.
class Twin : public trial::Observer {
 public:
  void on_step(int step, const physics::Engine& engine, const controllers::Batch&, const LaneArray&,
               int lane) override {
    const Quat q = engine.root_pose(lane).rotation;
    const Vec3 up = rotate(q, {0.0, 0.0, 1.0});
    upright += up.z;
    if (step % 100 == 0) com_m.push_back(engine.com_m(lane));
    height_m += engine.root_com_m(lane).z;
    for (int leg = 0; leg < engine.sensors().touch.rows(); ++leg)
      contacts += engine.sensors().touch.at(leg, lane) > 0.0f;
    touches.emplace_back();
    for (int leg = 0; leg < engine.sensors().touch.rows(); ++leg)
      touches.back().push_back(engine.sensors().touch.at(leg, lane) > 0.0f);
    const Vec3 ahead = rotate(q * conjugate(start), {1.0, 0.0, 0.0});
    turn_deg = std::atan2(ahead.y, ahead.x) * 180.0 / 3.141592653589793;
    const LaneArray& angle_rad = engine.sensors().joint_angle_rad;
    before_rad.resize(static_cast<std::size_t>(angle_rad.rows()), 0.0);  // at the start all are 0
    for (int joint = 0; joint < angle_rad.rows(); ++joint) {
      double& before = before_rad[static_cast<std::size_t>(joint)];
      energy_j += std::abs(engine.motor_torque_nm()->at(joint, lane) * (angle_rad.at(joint, lane) - before));
      before = angle_rad.at(joint, lane);
    }
    steps = step;
  }
  double upright = 0.0, energy_j = 0.0, height_m = 0.0, turn_deg = 0.0;
  int contacts = 0;
  Quat start;  ///< of the root in the start pose
  int steps = 0;
  std::vector<double> before_rad;
  std::vector<Vec3> com_m;                 ///< after each second
  std::vector<std::vector<bool>> touches;  ///< by step, of each leg
};

/// Steps of a touch after five without one, or since the start.
std::vector<int> footfalls(const Twin& twin, std::size_t leg) {
  std::vector<int> steps;
  for (int step = 0; step < static_cast<int>(twin.touches.size()); ++step) {
    bool off = true;
    for (int before = std::max(0, step - 5); before < step; ++before)
      off = off && !twin.touches[static_cast<std::size_t>(before)][leg];
    if (off && twin.touches[static_cast<std::size_t>(step)][leg]) steps.push_back(step);
  }
  return steps;
}

double mean_phase(const Twin& twin) {
  const auto first = footfalls(twin, 0);
  double sum = 0.0;
  for (std::size_t leg = 0; leg < twin.touches.at(0).size(); ++leg) {
    std::complex<double> mean{};
    for (const int step : footfalls(twin, leg))
      for (std::size_t i = 0; i + 1 < first.size(); ++i)
        if (first[i] <= step && step < first[i + 1])
          mean += std::polar(1.0, 2.0 * 3.141592653589793 * (step - first[i]) / (first[i + 1] - first[i]));
    const double turns = mean == 0.0 ? 0.0 : std::arg(mean) / (2.0 * 3.141592653589793);
    sum += turns < 0.0 ? turns + 1.0 : turns;
  }
  return sum / static_cast<double>(twin.touches[0].size());
}

/// Angles and targets of all joints after each step.
class JointObserver : public trial::Observer {
 public:
  void on_step(int, const physics::Engine& engine, const controllers::Batch&, const LaneArray& targets_rad,
               int lane) override {
    for (int joint = 0; joint < targets_rad.rows(); ++joint) {
      angle_rad.push_back(engine.sensors().joint_angle_rad.at(joint, lane));
      target_rad.push_back(targets_rad.at(joint, lane));
    }
  }
  std::vector<float> angle_rad, target_rad;
};

TEST(Recording, HasAnglesAndTargetsInTheColumnsOfTheirNames) {
  const TemporaryFolder scratch;
  const Problem problem = small_problem(small_config({"engine=batch"}));
  JointObserver joints;
  ASSERT_TRUE(replay(problem, small_population(problem).genomes()[3],
                     {.record = scratch / "a.rec", .observer = &joints}, never));
  record::RecordingReader reader(scratch / "a.rec");
  const auto& columns = reader.header().columns;
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
  };
  std::vector<float> frame;
  std::size_t i = 0;
  while (reader.next(frame))
    for (const robot::Joint& joint : problem.robot.joints) {
      ASSERT_EQ(frame.at(column("angle." + joint.name)), joints.angle_rad.at(i)) << joint.name;
      ASSERT_EQ(frame.at(column("target." + joint.name)), joints.target_rad.at(i++)) << joint.name;
    }
  EXPECT_EQ(i, joints.angle_rad.size());
  EXPECT_NE(joints.angle_rad, joints.target_rad);
}

class ScoreInEachEngine : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Engine, ScoreInEachEngine, testing::Values("ode", "batch", "mujoco"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST_P(ScoreInEachEngine, IsOfWhatItsTrialMeasured) {
  Problem problem = small_problem(small_config({std::string("engine=") + GetParam()}));
  const auto population = small_population(problem);
  const auto score_of = [&](const std::string& quantity, Twin& twin) {
    problem.score.terms = {{.quantity = quantity}};
    return replay(problem, population.genomes()[3], {.observer = &twin}, never)->result;
  };
  Twin upright, energy;
  const auto leaning = score_of("uprightness", upright);
  EXPECT_NEAR(leaning.score.value(), upright.upright / upright.steps, 1e-6);
  EXPECT_LT(leaning.score.value(), 1.0);
  const auto economical = score_of("economy", energy);
  const double weight_n = problem.robot.total_mass_kg() * 9.8;
  EXPECT_GT(energy.energy_j, 0.01);
  EXPECT_NEAR(economical.score.value(), weight_n * economical.distance_m / energy.energy_j,
              1e-9 * economical.score.value());
  Twin seconds;
  problem.score.speed_m_s = 0.2;
  const auto steady = score_of("speed_kept", seconds);
  double close = 0.0, before_m = robot::start_com_m(problem.robot).x;
  for (const Vec3 com_m : seconds.com_m) {
    close += std::max(0.0, 1.0 - std::abs(com_m.x - before_m - 0.2) / 0.2);
    before_m = com_m.x;
  }
  ASSERT_EQ(seconds.com_m.size(), 1U) << "the trial is that long";
  EXPECT_NEAR(steady.score.value(), close, 1e-6);
  Twin height, contacts, turn;
  turn.start = problem.robot.bodies[0].rotation;
  const double mean_height_m = score_of("height", height).score.value();
  EXPECT_NEAR(mean_height_m, height.height_m / height.steps, 1e-9);
  const double duty_factor = score_of("duty_factor", contacts).score.value();
  EXPECT_NEAR(duty_factor, contacts.contacts / (4.0 * contacts.steps), 1e-9);
  EXPECT_GT(duty_factor, 0.1);
  const double turned_deg = score_of("turn", turn).score.value();
  EXPECT_NEAR(turned_deg, turn.turn_deg, 1e-4);
  EXPECT_EQ(leaning.distance_m, economical.distance_m) << "measuring changes no bit";
}

TEST_P(ScoreInEachEngine, HasThePhasesOfItsFootfalls) {
  Problem problem = small_problem(small_config({std::string("engine=") + GetParam()}));
  problem.trial.duration_s = 6.0;
  problem.score.terms = {{.quantity = "phase"}};
  const auto population = small_population(problem);
  int with_strides = 0;
  for (const auto& genome : population.genomes()) {
    Twin twin;
    const auto result = replay(problem, genome, {.observer = &twin}, never)->result;
    EXPECT_NEAR(result.score.value(), mean_phase(twin), 1e-9);
    with_strides += footfalls(twin, 0).size() > 2;
    if (with_strides == 3) break;
  }
  EXPECT_EQ(with_strides, 3) << "genomes whose first leg steps";
}

TEST(ScoredRun, SelectsAndKeepsChampionsByItsScoreAndGoesOnAfterAnInterruption) {
  const TemporaryFolder scratch;
  const auto config =
      small_config({"engine=batch", "score.heading_deg=90",
                    "score.terms=[{quantity=\"heading\"}, {quantity=\"economy\", weight=0.1}]",
                    "score.limits=[{quantity=\"uprightness\", least=0.5}]"});
  Listener whole, part(1), rest;
  Run::start(scratch / "whole", config, 2).execute(whole, whole.stop);
  Run::start(scratch / "part", config, 1).execute(part, part.stop);
  Run::resume(scratch / "part", {}, 2).execute(rest, rest.stop);
  const auto file = RunPaths(scratch / "whole").best_champion();
  const auto champion = load_champion(file);
  EXPECT_EQ(champion.objective(), whole.rows.back().best_so_far);
  EXPECT_EQ(champion.problem.score.limits.at(0).least, 0.5);
  EXPECT_NE(champion.objective(), champion.result.distance_m);
  EXPECT_EQ(io::read_file(RunPaths(scratch / "part").best_champion()), io::read_file(file));
  const auto again = replay(champion.problem, champion.genome, {}, never);
  EXPECT_EQ(again->result.score, champion.result.score);
}

TEST(ScoredRun, TellsItsChampionsFromThoseOfRunsWithAnotherScore) {
  const TemporaryFolder scratch;
  Listener listener;
  Run::start(scratch / "plain", small_config({"engine=batch"}), 2).execute(listener, listener.stop);
  Run::start(scratch / "scored", small_config({"engine=batch", "score.terms=[{quantity=\"uprightness\"}]"}),
             2)
      .execute(listener, listener.stop);
  for (const auto& [own, other] : {std::pair{"plain", "scored"}, {"scored", "plain"}}) {
    const RunPaths paths(scratch / own);
    const auto origin = origin_of(paths);
    EXPECT_TRUE(verify_champion(paths.champion(0), never, &origin)->agrees);
    const auto foreign = verify_champion(RunPaths(scratch / other).champion(0), never, &origin);
    EXPECT_FALSE(foreign->agrees);
    EXPECT_NE(foreign->text.find("its score is not the run's"), std::string::npos) << foreign->text;
  }
}

TEST(ScoredRun, OfTheDistanceAloneIsTheRunWithoutAScore) {
  const TemporaryFolder scratch;
  Listener listener;
  Run::start(scratch / "plain", small_config({"engine=batch"}), 2).execute(listener, listener.stop);
  Run::start(scratch / "named", small_config({"engine=batch", "score.terms=[{quantity=\"distance\"}]"}), 2)
      .execute(listener, listener.stop);
  EXPECT_EQ(io::read_file(RunPaths(scratch / "plain").best_champion()),
            io::read_file(RunPaths(scratch / "named").best_champion()));
}

}  // namespace scored_run_test
}  // namespace amble::experiment
