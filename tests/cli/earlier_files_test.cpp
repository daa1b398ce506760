#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/process.hpp"

// Files that earlier builds wrote, in tests/formats/VERSION: they are read by this one, as docs/LIBRARY.md
// promises. A version that changes a format adds a folder of its own and keeps the others.
namespace amble::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> versions() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(AMBLE_SOURCE_DIR "/tests/formats"))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

class FilesOf : public testing::TestWithParam<std::string> {
 protected:
  /// A copy, which may be changed, of what that version wrote.
  std::string copy(const std::string& name) const {
    const fs::path from = fs::path(AMBLE_SOURCE_DIR "/tests/formats") / GetParam() / name;
    fs::copy(from, scratch_ / name, fs::copy_options::recursive);
    return (scratch_ / name).string();
  }
  static Finished good(const std::vector<std::string>& words) {
    auto finished = amble(words);
    EXPECT_EQ(finished.exit_code, 0) << words.front() << ": " << finished.err;
    return finished;
  }
  static long rows(const std::string& run) {
    return std::ranges::count(slurp(fs::path(run) / "generations.csv"), '\n');
  }

  const TemporaryFolder scratch_;
};

TEST_P(FilesOf, RunsAreToldAndGoOn) {
  const std::string run = copy("novelty-run");
  EXPECT_THAT(good({"info", run}).out, HasSubstr("ctrnn"));
  EXPECT_EQ(rows(run), 3);
  good({"resume", run, "--generations", "4"});
  EXPECT_EQ(rows(run), 5);
}

TEST_P(FilesOf, MapsAreToldAndFillOn) {
  const std::string run = copy("map-run");
  EXPECT_THAT(good({"repertoire", run}).out, HasSubstr("of 625 cells"));
  good({"resume", run, "--generations", "3"});
  EXPECT_EQ(rows(run), 4);
}

TEST_P(FilesOf, ChampionsWalk) {
  const std::string run = copy("novelty-run");
  EXPECT_THAT(good({"trial", run + "/champions/00000.json", "--undisturbed"}).out, HasSubstr("distance"));
  good({"view", run, "-o", scratch_ / "walk.html"});
  good({"export", run, "--format", "c", "-o", scratch_ / "walker.c"});
}

TEST_P(FilesOf, RecordingsAndRobotsAreRead) {
  const std::string walk = copy("walk.rec");
  EXPECT_THAT(good({"gait", walk}).out, HasSubstr("gait"));
  good({"view", walk, "-o", scratch_ / "walk.html"});
  good({"robot", copy("map-run") + "/robot.json"});
}

TEST_P(FilesOf, LedgersAreReported) {
  good({"report", copy("study"), "-o", scratch_ / "report.html"});
  EXPECT_THAT(slurp(scratch_ / "report.html"), HasSubstr("SUPGs walk farther than sine wave networks."));
}

INSTANTIATE_TEST_SUITE_P(EarlierVersions, FilesOf, testing::ValuesIn(versions()), [](const auto& version) {
  std::string name = "v" + version.param;
  std::ranges::replace(name, '.', '_');
  return name;
});

}  // namespace
}  // namespace amble::tests
