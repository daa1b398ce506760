#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/original_model.hpp"
#include "tests/experiment/fixture.hpp"
#include "tests/models/small_models.hpp"

// Runs of robots that carry their models.
namespace amble::experiment {
namespace {

using testing::HasSubstr;

class OwnModelRun : public testing::Test {
 protected:
  /// A config for a robot whose model is in a folder of its own, which is gone afterwards.
  Config config(std::vector<std::string> more = {}) {
    const std::string folder = scratch_ / "model", mjcf = folder + "/own.xml";
    std::filesystem::create_directories(folder);
    io::write_file(mjcf, tests::model_text(tests::four_legs(), "<freejoint/>", "",
                                           tests::motors(R"(position kp="30" forcerange="-9 9")"),
                                           R"(<option timestep="0.005" solver="PGS"/>)"));
    io::write_file(folder + "/own.toml",
                   morphology::guess_robot(morphology::compile_model(mjcf), "own.xml", true).toml);
    more.insert(more.begin(),
                {"robot=" + folder + "/own.toml", "controller.substrate=auto", "population.size=20",
                 "noise.episodes=2", "noise.push_m_s=0.1", "noise.start_tilt_rad=0.05"});
    Config made = small_config(std::move(more));
    made.robot = folder + "/own.toml";
    robot_ = load_robot(made);
    std::filesystem::remove_all(folder);
    return made;
  }

  TemporaryFolder scratch_;
  robot::RobotSpec robot_;
};

TEST_F(OwnModelRun, IsTheSameForAnyNumberOfWorkersAndAfterAnInterruptionAndIsVerified) {
  const Config in_model = config({"engine=mujoco-model"});
  Listener one, three, first(2), second;
  ASSERT_EQ(Run::start(scratch_ / "one", in_model, robot_, 1).execute(one, one.stop), RunStatus::finished);
  ASSERT_EQ(Run::start(scratch_ / "three", in_model, robot_, 3).execute(three, three.stop),
            RunStatus::finished);
  ASSERT_EQ(Run::start(scratch_ / "two", in_model, robot_, 2).execute(first, first.stop),
            RunStatus::interrupted);
  ASSERT_EQ(Run::resume(scratch_ / "two", {}, 1).execute(second, second.stop), RunStatus::finished);
  const std::string expected = champion_bytes(scratch_ / "one");
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_TRUE(champion_bytes(scratch_ / "three") == expected);
  EXPECT_TRUE(champion_bytes(scratch_ / "two") == expected);
  const RunPaths paths(scratch_ / "one");
  const Origin origin = origin_of(paths);
  for (const auto& file : paths.champion_files())
    EXPECT_TRUE(verify_champion(file, unstopped, &origin)->agrees);
}

TEST_F(OwnModelRun, ChampionsTravelWithTheModelAndWalkInIt) {
  const Config in_batch = config({"engine=batch", "referees=[\"mujoco-model\"]"});
  Listener listener;
  ASSERT_EQ(Run::start(scratch_ / "run", in_batch, robot_, 2).execute(listener, listener.stop),
            RunStatus::finished);
  const Champion champion = load_champion(RunPaths(scratch_ / "run").best_champion());
  ASSERT_NE(champion.problem.robot.original, nullptr);
  EXPECT_EQ(champion.problem.robot.original->mjcf, robot_.original->mjcf);
  ASSERT_EQ(champion.referees.size(), 1u);
  EXPECT_EQ(champion.referees[0].engine, "mujoco-model");
  EXPECT_EQ(champion.referees[0].result.outcome, record::Outcome::completed);
  const auto again = replay(champion.problem, champion.genome, {.engine = "mujoco-model"}, unstopped);
  EXPECT_EQ(again->result.distance_m, champion.referees[0].result.distance_m);
  EXPECT_NE(again->result.distance_m, champion.result.distance_m);
  const auto robot = load_robot_file(RunPaths(scratch_ / "run").robot);
  EXPECT_TRUE(robot::same_original_model(robot, robot_));
}

TEST_F(OwnModelRun, AResumeTellsAnotherModel) {
  const Config in_batch = config({"engine=batch"});
  Listener listener(1);
  Run::start(scratch_ / "run", in_batch, robot_, 2).execute(listener, listener.stop);
  auto other = *robot_.original;
  other.mjcf += "\n";
  robot::RobotSpec altered = robot_;
  altered.original = std::make_shared<const robot::OriginalModel>(other);
  io::write_file(RunPaths(scratch_ / "run").robot, robot_file_text(altered));
  try {
    Run::resume(scratch_ / "run", {}, 1);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not the robot that the run had"));
  }
}

TEST_F(OwnModelRun, LeavesFilesOfOtherRobotsAsTheyWere) {
  const Problem plain = small_problem();
  EXPECT_EQ(robot_file_text(plain.robot).find("original_model"), std::string::npos);
  config();
  const std::string with_model = robot_file_text(robot_);
  EXPECT_NE(with_model.find("original_model"), std::string::npos);
  const robot::RobotSpec read = robot_from_text(with_model, "text");
  EXPECT_EQ(robot_file_text(read), with_model);
}

TEST_F(OwnModelRun, IsRecordedAsInAnyEngine) {
  const Config in_model = config({"engine=mujoco-model"});
  const Problem problem = Problem::make(in_model, robot_);
  const auto genome = small_population(problem).genomes()[0];
  const auto path = scratch_ / "walk.amblerec";
  const auto walked = replay(problem, genome, {.record = path}, unstopped);
  record::RecordingReader recording(path);
  EXPECT_EQ(recording.header().robot_json.find("original_model"), std::string::npos);
  EXPECT_EQ(walked->result.steps, 100);
}

}  // namespace
}  // namespace amble::experiment
