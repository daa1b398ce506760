#include "amble/experiment/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::HasSubstr;

template <typename Call>
std::string complaint(Call call) {
  try {
    call();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

class Folder : public testing::Test {
 protected:
  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path / "run";
  Config config_ = small_config();
  morphology::RobotSpec robot_ = load_robot_file(config_.robot);

  std::string creating() {
    return complaint([&] { RunFolder::create(folder_, config_, robot_); });
  }
};

TEST_F(Folder, NeedsNothingOutsideItself) {
  RunFolder::create(folder_, config_, robot_);
  const auto moved = scratch_.path / "elsewhere";
  std::filesystem::rename(folder_, moved);
  const auto run = RunFolder::open(moved);
  EXPECT_EQ(run.load_robot().name, robot_.name);
  EXPECT_EQ(run.load_config().robot, (moved / "robot.json").string());
}

TEST_F(Folder, ThatHoldsARunIsNotTakenAgain) {
  RunFolder::create(folder_, config_, robot_);
  const auto before = io::read_file(folder_ / "config.toml");
  config_.name = "other";
  EXPECT_THAT(creating(), HasSubstr("holds a run already; go on with it by `amble resume"));
  EXPECT_EQ(io::read_file(folder_ / "config.toml"), before);
}

TEST_F(Folder, ThatHoldsAnythingElseIsLeftAlone) {
  std::filesystem::create_directories(folder_);
  io::write_file(folder_ / "thesis.txt", "years of work");
  EXPECT_THAT(creating(), HasSubstr("not empty and not a run"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(Folder, CannotBeAFile) {
  io::write_file(folder_, "x");
  EXPECT_THAT(creating(), HasSubstr("a file of that name exists"));
}

TEST_F(Folder, IsHeldByOneAtATime) {
  const auto held = RunFolder::create(folder_, config_, robot_);
  EXPECT_THAT(complaint([&] { RunFolder::open(folder_); }), HasSubstr("in use"));
}

TEST_F(Folder, ThatIsMissingOrNoRunCannotBeResumed) {
  EXPECT_THAT(complaint([&] { RunFolder::open(folder_); }), HasSubstr("no such folder"));
  std::filesystem::create_directories(folder_);
  EXPECT_THAT(complaint([&] { RunFolder::open(folder_); }), HasSubstr("not a run folder"));
}

TEST_F(Folder, ManifestGrowsByEachProcess) {
  const auto run = RunFolder::create(folder_, config_, robot_);
  run.note_process(config_, 2, 0);
  run.note_process(config_, 1, 17);
  const auto manifest = io::Json::parse(io::read_file(folder_ / "manifest.json"));
  ASSERT_EQ(manifest["processes"].size(), 2u);
  EXPECT_EQ(manifest["processes"][1]["from_generation"], 17);
  EXPECT_EQ(manifest["seed"], 1);
}

TEST_F(Folder, ChampionsAreListedInTheOrderOfTheirGenerations) {
  const auto run = RunFolder::create(folder_, config_, robot_);
  for (const int generation : {100, 2, 30}) io::write_file(run.paths().champion(generation), "{}");
  const auto files = run.paths().champion_files();
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files.front().filename(), "00002.json");
  EXPECT_EQ(run.paths().best_champion().filename(), "00100.json");
}

}  // namespace
}  // namespace amble::experiment
