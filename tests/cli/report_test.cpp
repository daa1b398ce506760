#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// A finished study of two conditions, two seeds and two generations, in a folder that all tests share.
class ReportCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const std::string configs = std::string(AMBLE_SOURCE_DIR) + "/configs/authors/";
    spill(*shared_ / "study.toml",
          "name = \"tiny\"\ntitle = \"<tiny> & \\\"small\\\"\"\nseeds = [1, 2]\ngenerations = 2\n"
          "settings = [\"engine=batch\", \"population.size=20\", \"speciation.target_min=3\", "
          "\"speciation.target_max=6\", \"trial.duration_s=1\"]\n"
          "[[conditions]]\nname = \"supg\"\nconfig = \"" +
              configs +
              "supg-objective.toml\"\n"
              "[[conditions]]\nname = \"sine\"\nconfig = \"" +
              configs +
              "sine-objective.toml\"\n"
              "[[tests]]\nname = \"longer\"\nseconds = 2\n"
              "[[claims]]\ntext = \"SUPGs walk farther.\"\ncondition = \"supg\"\nagainst = \"sine\"\n");
    const auto made =
        amble({"study", *shared_ / "study.toml", "--out", *shared_ / "s", "--jobs", "1", "--discard-runs"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() { shared_.reset(); }

  static Finished report(const std::string& study, const std::string& out,
                         std::vector<std::string> more = {}) {
    std::vector<std::string> words{"report", *shared_ / study, "-o", *shared_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return amble(words);
  }

  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> ReportCommand::shared_;

TEST_F(ReportCommand, WritesPageTablesJsonAndFigures) {
  const auto made =
      report("s", "out/report.html",
             {"--csv", *shared_ / "csv", "--json", *shared_ / "report.json", "--figures", *shared_ / "svg"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, testing::EndsWith("out/report.html\n"));
  const std::string page = slurp(*shared_ / "out/report.html");
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, HasSubstr("<h1>&lt;tiny&gt; &amp; &quot;small&quot;</h1>"));
  EXPECT_THAT(page, HasSubstr("SUPGs walk farther."));
  EXPECT_THAT(slurp(*shared_ / "report.json"), StartsWith("{\n  \"format\": \"amble-report\""));
  EXPECT_THAT(slurp(*shared_ / "csv/runs.csv"), HasSubstr("\nsupg,2,batch,2,"));
  EXPECT_TRUE(fs::exists(*shared_ / "svg/distance-longer.svg"));

  const auto files = [](const std::string& folder) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(*shared_ / folder))
      if (entry.is_regular_file()) found[entry.path().filename()] = slurp(entry.path());
    return found;
  };
  const auto before = files("csv");
  ASSERT_EQ(report("s", "out/report.html", {"--csv", *shared_ / "csv"}).exit_code, 0)
      << "its own files it replaces";
  EXPECT_EQ(slurp(*shared_ / "out/report.html"), page);
  EXPECT_EQ(files("csv"), before);
}

TEST_F(ReportCommand, NeedsNothingButStudyAndLedger) {
  fs::create_directories(*shared_ / "copy");
  fs::copy(*shared_ / "s/study.toml", *shared_ / "copy/study.toml");
  fs::copy(*shared_ / "s/ledger", *shared_ / "copy/ledger");
  ASSERT_EQ(report("copy", "copy.html").exit_code, 0);
  ASSERT_EQ(report("s", "s.html").exit_code, 0);
  EXPECT_EQ(slurp(*shared_ / "copy.html"), slurp(*shared_ / "s.html"));
  fs::remove(*shared_ / "copy/ledger/sine-002.json");
  ASSERT_EQ(report("copy", "part.html").exit_code, 0);
  EXPECT_THAT(slurp(*shared_ / "part.html"), HasSubstr("3 of 4 runs are in"));
}

TEST_F(ReportCommand, ReplacesNoFilesOfOtherKinds) {
  fs::create_directories(*shared_ / "mine");
  spill(*shared_ / "mine/notes.html", "my notes");
  EXPECT_EQ(report("s", "mine/notes.html").exit_code, 2);
  EXPECT_EQ(slurp(*shared_ / "mine/notes.html"), "my notes");
  spill(*shared_ / "mine/runs.csv", "my,runs\n");
  const auto refused = report("s", "mine/page.html", {"--csv", *shared_ / "mine"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("runs.csv exists and is not a table of a report"));
  EXPECT_FALSE(fs::exists(*shared_ / "mine/page.html")) << "nothing is written by halves";
  EXPECT_FALSE(fs::exists(*shared_ / "mine/claims.csv"));
  for (const char* mine :
       {"condition,seed,color\na,1,red\n", "condition,seed,engine,generations\na,1,mine,2\n"}) {
    spill(*shared_ / "mine/runs.csv", mine);
    EXPECT_EQ(report("s", "mine/page.html", {"--csv", *shared_ / "mine"}).exit_code, 2);
    EXPECT_EQ(slurp(*shared_ / "mine/runs.csv"), mine);
  }
  const std::string record = slurp(*shared_ / "s/ledger/supg-001.json");
  EXPECT_EQ(report("s", "page.html", {"--json", *shared_ / "s/ledger/supg-001.json"}).exit_code, 2);
  EXPECT_EQ(slurp(*shared_ / "s/ledger/supg-001.json"), record);
}

TEST_F(ReportCommand, ReplacesItsTablesOfAStudyWithOtherTests) {
  fs::create_directories(*shared_ / "tested");
  std::string study = slurp(*shared_ / "s/study.toml");
  const std::string name = "name = \"longer\"";
  study.replace(study.find(name), name.size(), "name = \"other\"");
  spill(*shared_ / "tested/study.toml", study);
  ASSERT_EQ(report("s", "replaced.html", {"--csv", *shared_ / "replaced"}).exit_code, 0);
  const std::string before = slurp(*shared_ / "replaced/runs.csv");
  const auto again = report("tested", "replaced.html", {"--csv", *shared_ / "replaced"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(slurp(*shared_ / "replaced/runs.csv"), before);
}

TEST_F(ReportCommand, ChecksAllItsOutputsBeforeItWritesAny) {
  fs::create_directories(*shared_ / "folder");
  fs::create_directories(*shared_ / "taken/runs.csv");
  spill(*shared_ / "file", "");
  struct Case {
    std::string out;
    std::vector<std::string> more;
    std::string message;
  };
  const std::vector<Case> cases{
      {"none.html", {"--json", *shared_ / "none.html"}, "none.html would be written twice"},
      {"none.html", {"--json", *shared_ / "folder/../none.html"}, "would be written twice"},
      {"none/runs.csv", {"--csv", *shared_ / "none"}, "runs.csv would be written twice"},
      {"none.html", {"--csv", *shared_ / "file"}, "file is a file: name a folder"},
      {"none.html", {"--figures", *shared_ / "file"}, "file is a file: name a folder"},
      {"none.html", {"--csv", *shared_ / "taken"}, "runs.csv is a folder"},
      {"none.html", {"--json", *shared_ / "folder"}, "folder is a folder: name a file"},
      {"none.html", {"--csv", ""}, "--csv \"\": the value is empty"},
      {"none.html", {"--figures", ""}, "--figures \"\": the value is empty"},
      {"none.html", {"--json", ""}, "--json \"\": the value is empty"},
      {"none.html", {"--json", *shared_ / "file/below.json"}, "Not a directory"},
      {"folder", {}, "folder is a folder: name a file"}};
  for (const auto& [out, more, message] : cases) {
    const auto refused = report("s", out, more);
    EXPECT_NE(refused.exit_code, 0) << message;
    EXPECT_THAT(refused.err, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
    EXPECT_FALSE(fs::exists(*shared_ / "none.html")) << message;
    EXPECT_FALSE(fs::exists(*shared_ / "none")) << message;
  }
}

TEST_F(ReportCommand, SaysWhatIsWrongWithAStudy) {
  const auto no_folder = report("nowhere", "x.html");
  EXPECT_EQ(no_folder.exit_code, 4);
  EXPECT_THAT(no_folder.err, HasSubstr("no such folder"));
  fs::create_directories(*shared_ / "empty");
  const auto no_study = report("empty", "x.html");
  EXPECT_EQ(no_study.exit_code, 2);
  EXPECT_THAT(no_study.err, HasSubstr("study.toml is missing"));
  fs::create_directories(*shared_ / "bad");
  fs::copy(*shared_ / "s/study.toml", *shared_ / "bad/study.toml");
  fs::copy(*shared_ / "s/ledger", *shared_ / "bad/ledger");
  const std::string record = slurp(*shared_ / "bad/ledger/supg-001.json");
  spill(*shared_ / "bad/ledger/supg-001.json", record.substr(0, record.size() / 2));
  const auto cut = report("bad", "x.html");
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_THAT(cut.err, HasSubstr("supg-001.json"));
  EXPECT_FALSE(fs::exists(*shared_ / "x.html"));
}

}  // namespace
}  // namespace amble::tests
