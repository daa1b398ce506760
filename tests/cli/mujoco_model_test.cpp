#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "amble/io/json_file.hpp"
#include "tests/cli/process.hpp"
#include "tests/models/small_models.hpp"

// The engine of a robot's own model, from the model's file to a table.
namespace amble::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string hexapod = std::string(AMBLE_SOURCE_DIR) + "/robots/hexapod/";

class OwnModel : public testing::Test {
 protected:
  void SetUp() override {
    const std::string model = scratch_ / "mine.xml";
    spill(model, model_text(four_legs(), "<freejoint/>", "", motors(R"(position kp="30" forcerange="-9 9")"),
                            R"(<option timestep="0.004"/>)"));
    init_ = amble({"robot", "--init", model, "-o", scratch_ / "mine"});
    ASSERT_EQ(init_.exit_code, 0) << init_.err;
  }

  Finished evolve(const std::vector<std::string>& more) {
    std::vector<std::string> command{"evolve",        scratch_ / "mine/evolve.toml",
                                     "--set",         "population.size=20",
                                     "--set",         "trial.duration_s=1",
                                     "--set",         "champion.episodes=0",
                                     "--generations", "2",
                                     "--out",         run_};
    command.insert(command.end(), more.begin(), more.end());
    return amble(command);
  }

  TemporaryFolder scratch_;
  std::string run_ = scratch_ / "run";
  Finished init_;
};

TEST_F(OwnModel, InitSaysHowItIsSimulated) {
  EXPECT_THAT(init_.out,
              HasSubstr("in its own model, engine mujoco-model:\n"
                        "  the model's timestep of 0.004 s does not divide a tick of 0.01 s: 3 steps of "
                        "0.003333 s\n"
                        "  targets go to position actuators, with the model's gains: all joints\n"));
  EXPECT_THAT(slurp(scratch_ / "mine/mine.toml"), HasSubstr("\nkeep_model = true\n"));
}

TEST_F(OwnModel, JudgesARunWhoseModelIsGone) {
  ASSERT_EQ(evolve({}).exit_code, 0);
  std::filesystem::remove(scratch_ / "mine.xml");
  std::filesystem::remove_all(scratch_ / "mine");
  const auto table = amble({"compare", run_, "--trials", "2"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("in mujoco-model"));
  std::filesystem::rename(run_, scratch_ / "elsewhere");
  const auto trial = amble({"trial", scratch_ / "elsewhere", "--engine", "mujoco-model", "--undisturbed"});
  EXPECT_EQ(trial.exit_code, 0) << trial.err;
  for (const std::string command : {"gait", "verify"}) {
    const auto other = amble({command, scratch_ / "elsewhere"});
    EXPECT_EQ(other.exit_code, 0) << command << other.err;
  }
  const auto gait = amble({"gait", scratch_ / "elsewhere", "--engine", "mujoco-model"});
  EXPECT_EQ(gait.exit_code, 0) << gait.err;
}

TEST_F(OwnModel, EvolvesAndIsViewed) {
  const auto evolved = evolve({"--set", "engine=mujoco-model", "--set", "referees=[\"batch\"]"});
  ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
  EXPECT_EQ(amble({"verify", run_}).exit_code, 0);
  const std::string page = scratch_ / "walker.html";
  const auto view = amble({"view", run_, "-o", page, "--seconds", "1"});
  EXPECT_EQ(view.exit_code, 0) << view.err;
  EXPECT_THAT(slurp(page), Not(HasSubstr("original_model")));
}

TEST_F(OwnModel, IsRefusedWhereThereIsNone) {
  const auto trial = amble({"trial", hexapod + "champion.json", "--engine", "mujoco-model"});
  EXPECT_EQ(trial.exit_code, 2);
  EXPECT_EQ(
      trial.err,
      "amble: the engine mujoco-model: robot 'hexapod' does not carry the MJCF it was made from; that takes "
      "an MJCF model (no URDF), keep_model = true in the robot file, and a run begun with it\n");
  // By default a table has the engines that can simulate the robot.
  const auto table = amble({"compare", hexapod + "champion.json", "--seconds", "1", "--undisturbed"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, Not(HasSubstr("mujoco-model")));
  EXPECT_THAT(amble({"compare", hexapod + "champion.json", "--engines", "mujoco-model"}).err,
              HasSubstr("does not carry the MJCF"));
}

}  // namespace
}  // namespace amble::tests
