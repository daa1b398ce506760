#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

const std::string source = AMBLE_SOURCE_DIR;

TEST(Docs, SettingsAreTheProgramsOwnTable) {
  auto table = amble({"settings", source + "/configs/authors/supg-novelty.toml",
                      source + "/configs/paper/supg-novelty.toml"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  for (auto at = table.out.find(source); at != std::string::npos; at = table.out.find(source))
    table.out.erase(at, source.size() + 1);
  const auto page = slurp(source + "/docs/SETTINGS.md");
  EXPECT_NE(page.find(table.out), std::string::npos) << "run tools/update-docs";
}

TEST(Docs, EveryCommandExplainsItself) {
  for (const char* command :
       {"evolve", "resume", "trial", "compare", "info", "robot", "verify", "page", "settings"}) {
    const auto help = amble({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_NE(help.out.find("Usage"), std::string::npos) << command;
  }
}

TEST(Docs, TheReadmeStaysUnder200Lines) {
  const auto readme = slurp(source + "/README.md");
  EXPECT_LT(std::count(readme.begin(), readme.end(), '\n'), 200);
}

}  // namespace
}  // namespace amble::tests
