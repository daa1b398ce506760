#include "amble/ledger/study_spec.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::ledger {
namespace {

using test::TemporaryFolder;

constexpr const char* good = R"(name = "s"
seeds = [1, 2]
[[conditions]]
name = "a"
config = "a.toml"
[[conditions]]
name = "b"
config = "../b.toml"
seeds = [5]
[[tests]]
name = "five"
seconds = 300
[[claims]]
text = "A beats B."
kind = "difference"
condition = "a"
against = "b"
measure = "five.distance_m"
)";

/// The diagnostic for a study with this text; empty if it is accepted.
std::string diagnostic(const std::string& text) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", text);
  try {
    load_study(folder.path() / "s.toml");
    return {};
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return std::filesystem::path(error.what()).filename().string();
  }
}

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST(StudySpec, ResolvesConfigsAgainstItsFolder) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", good);
  const StudySpec study = load_study(folder.path() / "s.toml");
  EXPECT_EQ(study.conditions[0].config, (folder.path() / "a.toml").string());
  EXPECT_EQ(study.conditions[1].config, (folder.path().parent_path() / "b.toml").string());
  EXPECT_EQ(study.seeds_of(study.conditions[0]), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(study.seeds_of(study.conditions[1]), (std::vector<std::int64_t>{5}));
}

TEST(StudySpec, CopyReadsBackTheSame) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", good);
  const StudySpec study = load_study(folder.path() / "s.toml");
  io::write_file(folder.path() / "copy.toml", study.to_toml());
  const StudySpec copy = load_study(folder.path() / "copy.toml");
  EXPECT_EQ(copy.to_toml(), study.to_toml());
  EXPECT_EQ(copy.claims_hash(), study.claims_hash());
}

TEST(StudySpec, HashOfClaimsIsThatOfAnyStudyWithTheSameClaims) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", good);
  StudySpec study = load_study(folder.path() / "s.toml");
  const std::string claims = study.claims_hash();
  study.title = "another";
  study.seeds.push_back(77);
  EXPECT_EQ(study.claims_hash(), claims);
  study.claims.emplace_back();
  EXPECT_NE(study.claims_hash(), claims);
}

TEST(StudySpec, NamesHaveUpTo64Characters) {
  const auto named = [](std::size_t characters) {
    return diagnostic(replaced(good, "name = \"five\"", "name = \"" + std::string(characters, 'x') + "\""));
  };
  const std::string refusal = "expected 1 to 64 of a-z, 0-9, '-' and '_'";
  EXPECT_NE(named(0).find(refusal), std::string::npos);
  EXPECT_EQ(named(64).find(refusal), std::string::npos);
  EXPECT_NE(named(65).find(refusal), std::string::npos);
}

TEST(StudySpec, MistakesAreNamedWithTheirPlace) {
  EXPECT_EQ(diagnostic(good), "");
  EXPECT_EQ(diagnostic(replaced(good, "seeds = [1, 2]", "seeds = [1, 2, 1]")),
            "s.toml:2: 'seeds' has the seed 1 twice");
  EXPECT_EQ(diagnostic(replaced(good, "seeds = [1, 2]", "seeds = [1.5]")),
            "s.toml:2: 'seeds' has 1.5: expected whole numbers");
  EXPECT_EQ(diagnostic(replaced(good, "name = \"b\"", "name = \"a\"")),
            "s.toml:7: 'conditions[1].name' = \"a\": that name is taken");
  EXPECT_EQ(diagnostic(replaced(good, "name = \"b\"", "name = \"../b\"")),
            "b\": expected 1 to 64 of a-z, 0-9, '-' and '_'");
  EXPECT_EQ(diagnostic(replaced(good, "against = \"b\"", "against = \"c\"")),
            "s.toml:17: 'claims[0].against': expected the name of a condition, not \"c\"");
  EXPECT_EQ(
      diagnostic(replaced(good, "five.distance_m", "six.distance_m")),
      "s.toml:18: 'claims[0].measure': expected train_m, hidden, links, or TEST.distance_m, .upright_s, "
      ".walking_s, .kept, not \"six.distance_m\"");
  EXPECT_EQ(diagnostic(replaced(good, "kind = \"difference\"", "kind = \"ratio\"")),
            "s.toml:13: 'claims[0].at_least': expected at_least, at_most or both for a ratio");
  EXPECT_EQ(diagnostic(replaced(good, "seconds = 300", "seconds = 300\nepisodes = 3")),
            "s.toml:13: 'tests[0].episodes' = 3: without noise all trials are the same");
  EXPECT_EQ(diagnostic(replaced(good, "seeds = [1, 2]", "seed = [1, 2]")),
            "s.toml:2: unknown key 'seed' (did you mean 'seeds'?)");
  EXPECT_EQ(diagnostic("name = \"s\"\nseeds = [1]\n"),
            "s.toml: no conditions: expected at least one [[conditions]]");
}

}  // namespace
}  // namespace amble::ledger
