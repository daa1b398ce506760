#include "amble/experiment/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <typename Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

class Folder : public testing::Test {
 protected:
  TemporaryFolder scratch_;
  std::filesystem::path folder_ = scratch_ / "run";
  Config config_ = small_config();
  robot::RobotSpec robot_ = load_robot_file(config_.robot);

  std::string creating() {
    return error_of([&] { RunFolder::create(folder_, robot_); });
  }
  RunFolder begun() {
    auto run = RunFolder::create(folder_, robot_);
    run.note_process(config_, 1, 0);
    run.save_config(config_);
    return run;
  }
};

TEST_F(Folder, NeedsNothingOutsideItself) {
  begun();
  const auto moved = scratch_ / "elsewhere";
  std::filesystem::rename(folder_, moved);
  const auto run = RunFolder::open(moved);
  EXPECT_EQ(run.load_robot().name, robot_.name);
  EXPECT_EQ(run.load_config().robot, (moved / "robot.json").string());
}

TEST_F(Folder, ThatHoldsARunIsNotTakenAgain) {
  begun();
  const auto before = io::read_file(folder_ / "config.toml");
  config_.name = "other";
  EXPECT_THAT(creating(), HasSubstr("holds a run already; continue it with `amble resume"));
  EXPECT_EQ(io::read_file(folder_ / "config.toml"), before);
}

TEST_F(Folder, ThatHoldsAnythingElseIsLeftAlone) {
  std::filesystem::create_directories(folder_);
  io::write_file(folder_ / "thesis.txt", "years of work");
  EXPECT_THAT(creating(), HasSubstr("not empty and not a run"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(Folder, ThatNoStartHasLockedIsLeftAloneWhateverItsFilesAreCalled) {
  for (const auto* name : {"data.tmp.1", "manifest.json", "config.toml.tmp.1"}) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    io::write_file(folder_ / name, "years of work");
    EXPECT_THAT(creating(), HasSubstr("not empty and not a run")) << name;
    EXPECT_EQ(io::read_file(folder_ / name), "years of work");
  }
}

TEST_F(Folder, WhoseStartWasKilledBeforeItHadAConfigIsTakenAgain) {
  RunFolder::create(folder_, robot_);
  io::write_file(folder_ / "checkpoint.bin", "half");
  io::write_file(folder_ / "config.toml.tmp.4711", "ha");
  EXPECT_EQ(creating(), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "config.toml.tmp.4711"));
}

TEST_F(Folder, LosesTheTemporaryFilesOfAKilledProcess) {
  begun();
  io::write_file(folder_ / "checkpoint.bin.tmp.4711", "ha");
  io::write_file(folder_ / "champions/00001.json.tmp.4711", "ha");
  for (const auto& own : {"notes.tmp.old", "data.tmp.1", "checkpoint.bin.tmp.", "champions/00001.txt.tmp.1"})
    io::write_file(folder_ / own, "the user's own");
  RunFolder::open(folder_).remove_leftovers();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "checkpoint.bin.tmp.4711"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "champions/00001.json.tmp.4711"));
  for (const auto& own : {"notes.tmp.old", "data.tmp.1", "checkpoint.bin.tmp.", "champions/00001.txt.tmp.1"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / own)) << own;
}

TEST_F(Folder, OfAnotherVersionIsRefusedByThatName) {
  begun();
  io::write_file(folder_ / "manifest.json", io::sealed_json("amble-manifest", 1, {{"name", "old"}}));
  for (const auto& opening :
       {error_of([&] { RunFolder::open(folder_); }), error_of([&] { find_run(folder_); })})
    EXPECT_THAT(opening,
                HasSubstr("manifest.json: version 1 of the file format; this program reads version 6"));
}

TEST_F(Folder, NeedsAName) {
  folder_.clear();
  EXPECT_EQ(creating(), "--out: expected the name of a folder");
}

TEST_F(Folder, CannotBeAFile) {
  io::write_file(folder_, "x");
  EXPECT_THAT(creating(), HasSubstr("a file of that name exists"));
}

TEST_F(Folder, IsHeldByOneAtATime) {
  const auto held = begun();
  EXPECT_THAT(error_of([&] { RunFolder::open(folder_); }), HasSubstr("in use"));
}

TEST_F(Folder, ThatIsMissingOrNoRunCannotBeResumed) {
  EXPECT_THAT(error_of([&] { RunFolder::open(folder_); }), HasSubstr("no such folder"));
  std::filesystem::create_directories(folder_);
  EXPECT_THAT(error_of([&] { RunFolder::open(folder_); }), HasSubstr("not a run folder"));
  io::write_file(folder_ / "notes", "x");
  EXPECT_THAT(error_of([&] { RunFolder::open(folder_ / "notes"); }), HasSubstr("notes: not a folder"));
}

TEST_F(Folder, ThatWasStoppedInItsFirstGenerationHasNoChampionYet) {
  begun();
  const RunPaths paths(folder_);
  io::write_file(paths.checkpoint, "of generation 0");
  io::write_file(paths.generations, "generation,best\n");
  EXPECT_THAT(error_of([&] { paths.best_champion(); }),
              HasSubstr("no champion yet: its first generation is not done"));
  io::write_file(paths.generations, "generation,best\n0,1.5\n");
  EXPECT_THAT(error_of([&] { paths.best_champion(); }), HasSubstr("has no champion: was it emptied?"));
}

TEST_F(Folder, WithoutItsBestChampionDoesNotGiveTheSecond) {
  begun();
  const RunPaths paths(folder_);
  const std::string columns = "generation,best,best_so_far,mean,median,evaluations,steps,wall_s\n";
  const std::string rows =
      columns + "0,1,1,0,0,8,80,1\n1,3,1,0,0,8,80,1\n2,2,2,0,0,8,80,1\n3,1,2,0,0,8,80,1\n";
  io::write_file(paths.generations, rows);
  io::write_file(paths.champion(0), "{}");
  EXPECT_THAT(error_of([&] { paths.best_champion(); }),
              HasSubstr("00002.json: missing, and it is the best of the run so far"));
  io::write_file(paths.champion(2), "{}");
  EXPECT_EQ(paths.best_champion(), paths.champion(2));
  io::write_file(paths.generations, columns + "1,3,9,0,0,8,80,1\n0,1,1,0,0,8,80,1\n");
  EXPECT_EQ(paths.best_champion(), paths.champion(2)) << "of a table that was sorted";
  io::write_file(paths.generations, rows);
  io::write_file(paths.champion(4), "{}");  // of the generation in flight
  EXPECT_EQ(paths.best_champion(), paths.champion(4));
}

TEST_F(Folder, ManifestGrowsByEachProcess) {
  const auto run = begun();
  run.note_process(config_, 1, 17);
  const auto manifest = io::Json::parse(io::read_file(folder_ / "manifest.json"));
  ASSERT_EQ(manifest["processes"].size(), 2u);
  EXPECT_EQ(manifest["processes"][1]["from_generation"], 17);
  EXPECT_EQ(manifest["seed"], 1);
}

TEST_F(Folder, ChampionsAreListedInTheOrderOfTheirGenerations) {
  const auto run = begun();
  for (const int generation : {100'000, 99'999, 0, 2, 30, 2'000'000})
    io::write_file(run.paths().champion(generation), "{}");
  io::write_file(folder_ / "champions/zoo.json", "no champion");
  std::vector<std::string> names;
  for (const auto& file : run.paths().champion_files()) names.push_back(file.filename());
  EXPECT_THAT(names, ElementsAre("00000.json", "00002.json", "00030.json", "99999.json", "100000.json",
                                 "2000000.json"));
  EXPECT_EQ(run.paths().best_champion().filename(), "2000000.json");
}

}  // namespace
}  // namespace amble::experiment
