#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "amble/core/version.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

const std::string source = AMBLE_SOURCE_DIR;

/// Whether docs/SETTINGS.md holds what `amble settings` prints with these arguments.
void expect_in_settings_page(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "settings");
  auto table = amble(arguments);
  ASSERT_EQ(table.exit_code, 0) << table.err;
  for (auto at = table.out.find(source); at != std::string::npos; at = table.out.find(source))
    table.out.erase(at, source.size() + 1);
  const auto page = slurp(source + "/docs/SETTINGS.md");
  EXPECT_NE(page.find(table.out), std::string::npos) << "run tools/update-docs";
}

TEST(Docs, SettingsAreTheProgramsOwnTables) {
  const std::string authors = source + "/configs/authors/", paper = source + "/configs/paper/";
  expect_in_settings_page({authors + "supg-novelty.toml", paper + "supg-novelty.toml",
                           source + "/configs/robust/supg-objective.toml"});
  expect_in_settings_page({"--differing", authors + "supg-objective.toml", authors + "sine-objective.toml",
                           authors + "ctrnn-objective.toml"});
  expect_in_settings_page({"--robot"});
}

TEST(Docs, EveryCommandExplainsItself) {
  for (const char* command :
       {"evolve", "resume", "trial", "compare", "gait", "info", "robot", "verify", "page", "report", "study",
        "view", "settings", "substrate", "draw", "completion", "export"}) {
    const auto help = amble({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_NE(help.out.find("Usage"), std::string::npos) << command;
  }
}

TEST(Docs, HelpOfACommandIsThatOfItsOption) {
  const auto help = amble({"help", "evolve"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out, amble({"evolve", "--help"}).out);
  EXPECT_EQ(amble({"help"}).out, amble({"--help"}).out);
}

/// The commands that help lists.
std::vector<std::string> commands() {
  std::vector<std::string> names;
  std::istringstream lines(amble({"help"}).out.substr(amble({"help"}).out.find("\nEvolve:\n")));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST(Docs, EveryCommandsHelpHasExamplesAndLinesThatFitAScreen) {
  EXPECT_EQ(commands().size(), 21u);
  for (const std::string& command : commands()) {
    const auto help = amble({"help", command});
    EXPECT_EQ(help.exit_code, 0) << command;
    const auto examples = help.out.find("\nExample");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_NE(help.out.find("amble " + command, examples), std::string::npos) << command;
    std::istringstream lines(help.out.substr(0, examples));
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), 102u) << command << ": " << line;
  }
}

TEST(Docs, TheProgramWithoutArgumentsShowsItsHelp) {
  const auto bare = amble({}), help = amble({"--help"});
  EXPECT_EQ(bare.exit_code, 0);
  EXPECT_EQ(bare.out, help.out);
  EXPECT_EQ(bare.err, "");
}

TEST(Docs, HelpListsTheEnginesWhereOneIsChosen) {
  for (const char* command : {"trial", "gait", "page", "view", "compare"})
    EXPECT_NE(amble({command, "--help"}).out.find("ode|batch|mujoco"), std::string::npos) << command;
}

TEST(Docs, TheVersionIsThatOfTheBuildInEveryFileThatHasIt) {
  const std::string cmake = slurp(source + "/CMakeLists.txt"), before = "project(amble VERSION ";
  const std::size_t at = cmake.find(before) + before.size();
  const std::string version = cmake.substr(at, cmake.find(' ', at) - at);
  EXPECT_NE(slurp(source + "/CITATION.cff").find("\nversion: " + version + "\n"), std::string::npos)
      << version;
  for (const char* file : {"/codemeta.json", "/viewer/package.json", "/viewer/package-lock.json"})
    EXPECT_NE(slurp(source + file).find("\"version\": \"" + version + "\""), std::string::npos) << file;
  EXPECT_EQ(AMBLE_VERSION_TEXT, version) << "src/core/version.hpp";
  EXPECT_NE(slurp(source + "/docs/RELEASING.md").find("`git tag -s v" + version + " "), std::string::npos);
  const std::string changes = slurp(source + "/CHANGELOG.md");
  const std::size_t heading = changes.find("\n## [", changes.find("\n## [Unreleased]\n") + 1);
  EXPECT_TRUE(std::string_view(changes).substr(heading).starts_with("\n## [" + version + "] – "));
}

TEST(Docs, TheReadmeStaysUnder150Lines) {
  const auto readme = slurp(source + "/README.md");
  EXPECT_LT(std::count(readme.begin(), readme.end(), '\n'), 150);
}

}  // namespace
}  // namespace amble::tests
