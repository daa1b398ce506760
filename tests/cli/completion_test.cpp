#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A bash that has read the script for it, in a folder with one file and one folder.
class BashCompletion : public testing::Test {
 protected:
  void SetUp() override {
    const auto script = amble({"completion", "bash"});
    ASSERT_EQ(script.exit_code, 0) << script.err;
    spill(scratch_ / "amble.bash", script.out);
    std::filesystem::create_directories(scratch_ / "here/runs of may");
    spill(scratch_ / "here/walk.toml", "");
  }

  /// What it offers for the last of these words.
  std::vector<std::string> offered(const std::vector<std::string>& words) {
    std::string program = "set -eu; shopt -u extglob; compopt() { :; }; source '" +
                          (scratch_ / "amble.bash").string() + "'; cd '" + (scratch_ / "here").string() +
                          "'; COMP_WORDS=(";
    for (const std::string& word : words) program += "'" + word + "' ";
    program += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
               "; set +e; _amble; (( ${#COMPREPLY[@]} )) && printf '%s\\n' \"${COMPREPLY[@]}\"; exit 0";
    spill(scratch_ / "ask.bash", program);
    const std::string out = scratch_ / "out";
    const int status =
        std::system(("bash --norc '" + (scratch_ / "ask.bash").string() + "' > '" + out + "' 2>&1").c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << slurp(out);
    return lines_of(slurp(out));
  }

  TemporaryFolder scratch_;
};

TEST_F(BashCompletion, OffersCommandsFirst) {
  EXPECT_THAT(offered({"amble", "ev"}), ElementsAre("evolve"));
  EXPECT_THAT(offered({"amble", ""}), IsSupersetOf({"evolve", "trial", "completion", "--version", "--help"}));
  EXPECT_THAT(offered({"amble", "--ver"}), ElementsAre("--version"));
}

TEST_F(BashCompletion, OffersTheOptionsOfTheCommand) {
  EXPECT_THAT(offered({"amble", "evolve", "--se"}), UnorderedElementsAre("--set", "--seed"));
  EXPECT_THAT(offered({"amble", "view", "runs", "-"}), IsSupersetOf({"-o", "--out", "--engine", "--title"}));
  EXPECT_THAT(offered({"amble", "study", "-"}), testing::Not(Contains("--child"))) << "help does not show it";
}

TEST_F(BashCompletion, OffersValuesThatAreKnown) {
  EXPECT_THAT(offered({"amble", "trial", "--engine", ""}), IsSupersetOf({"ode", "batch", "mujoco"}));
  EXPECT_THAT(offered({"amble", "trial", "--engine", "=", "b"}), ElementsAre("batch"));
  EXPECT_EQ(offered({"amble", "trial", "--engine", "="}), offered({"amble", "trial", "--engine", ""}));
  EXPECT_THAT(offered({"amble", "compare", "x", "--format", "m"}), ElementsAre("markdown"));
  EXPECT_THAT(offered({"amble", "completion", ""}), UnorderedElementsAre("bash", "zsh", "fish"));
  EXPECT_THAT(offered({"amble", "help", "comp"}), UnorderedElementsAre("compare", "completion"));
}

TEST_F(BashCompletion, OffersEachValueOfAList) {
  EXPECT_THAT(offered({"amble", "compare", "x", "--engines", "b"}), ElementsAre("batch"));
  EXPECT_THAT(offered({"amble", "compare", "x", "--engines", "ode,batch,mujoco-"}),
              ElementsAre("ode,batch,mujoco-model"));
  EXPECT_THAT(offered({"amble", "compare", "x", "--engines", "=", "ode,"}), Contains("ode,batch"));
}

TEST_F(BashCompletion, OffersTheKeysOfSettings) {
  EXPECT_THAT(offered({"amble", "evolve", "--set", "population.si"}), ElementsAre("population.size="));
  EXPECT_THAT(offered({"amble", "substrate", "--set", "controller.supg.tri"}),
              IsSupersetOf({"controller.supg.trigger="}));
  EXPECT_THAT(offered({"amble", "evolve", "--set", "nothing."}), ElementsAre());
}

TEST_F(BashCompletion, OffersFilesWhereAPathIsExpectedAndNothingWhereANumberIs) {
  EXPECT_THAT(offered({"amble", "evolve", "w"}), ElementsAre("walk.toml"));
  EXPECT_THAT(offered({"amble", "trial", "runs"}), ElementsAre("runs of may"));
  EXPECT_THAT(offered({"amble", "evolve", "walk.toml", "--out", ""}),
              UnorderedElementsAre("walk.toml", "runs of may"));
  EXPECT_THAT(offered({"amble", "evolve", "walk.toml", "--seed", ""}), ElementsAre());
  for (const char* option : {"--command", "--damage"})
    EXPECT_THAT(offered({"amble", "trial", option, "w"}), ElementsAre("walk.toml")) << "or in one line";
  EXPECT_THAT(offered({"amble", "trial", "--steering", ""}), ElementsAre());
}

TEST_F(BashCompletion, KnowsEveryCommandAndOptionThatHelpShows) {
  for (const std::string& command : offered({"amble", ""})) {
    if (command.starts_with("-")) continue;
    const auto help = amble({command, "--help"}).out;
    for (const std::string& option : offered({"amble", command, "--"}))
      EXPECT_NE(help.find(option), std::string::npos) << command << " " << option;
    const auto all = offered({"amble", command, "--"});
    std::istringstream words(help);
    for (std::string word; words >> word;) {
      if (!word.starts_with("--")) continue;
      word = word.substr(0, word.find_first_of(",;:.)="));
      const bool listed = word.size() > 2 && help.find("\n  " + word) != std::string::npos;
      EXPECT_TRUE(!listed || std::ranges::count(all, word) == 1) << command << " " << word;
    }
  }
}

/// Whether a shell, where it is installed, can read the script for it.
void expect_readable(const std::string& shell, const std::string& check) {
  const TemporaryFolder scratch;
  spill(scratch / "script", amble({"completion", shell}).out);
  if (std::system(("command -v " + shell + " >/dev/null").c_str()) != 0)
    GTEST_SKIP() << shell << " is not installed";
  EXPECT_EQ(std::system((check + " '" + (scratch / "script").string() + "'").c_str()), 0);
}

TEST(ZshCompletion, IsAScriptThatZshCanRead) {
  expect_readable("zsh", "zsh -n");
}

TEST(FishCompletion, IsAScriptThatFishCanRead) {
  expect_readable("fish", "fish --no-execute");
}

TEST(Completion, ForAnotherShellIsRefused) {
  const auto refused = amble({"completion", "tcsh"});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, testing::HasSubstr("tcsh not in {bash,zsh,fish}"));
}

}  // namespace
}  // namespace amble::tests
