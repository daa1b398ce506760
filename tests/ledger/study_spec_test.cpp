#include "amble/ledger/study_spec.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/ledger/ledger.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/ledger/study_text.hpp"

namespace amble::ledger {
namespace {

using test::TemporaryFolder;

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

TEST(StudySpec, HashOfClaimsCoversTheVersionsOfTheirRules) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", good);
  StudySpec study = load_study(folder.path() / "s.toml");
  std::set<std::string> hashes;
  for (const int verdicts : {1, 2, 3})
    for (const int stop : {1, 2}) hashes.insert(study.claims_hash({verdicts, stop}));
  EXPECT_EQ(hashes.size(), 6u);
  EXPECT_EQ(study.claims_hash(), study.claims_hash(current_rules));
  study.claims[0].margin = 0.5;
  EXPECT_FALSE(hashes.contains(study.claims_hash(first_rules)));
}

TEST(StudySpec, RecordsFromBeforeTheRulesHadVersionsHoldTheHashOfTheirClaimsAlone) {
  const StudyPaths paths(AMBLE_SOURCE_DIR "/results/legs");
  const StudySpec study = load_study_copy(paths);
  const auto records = Ledger(paths).load_all(study);
  EXPECT_EQ(records.size(), 4u);
  for (const Record& record : records) EXPECT_EQ(study.rules_of(record.provenance.claims), first_rules);
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
  EXPECT_EQ(diagnostic(replaced(good, "five.distance_m", "six.distance_m")),
            "s.toml:18: 'claims[0].measure': expected a measure of a test that the study has (five); not "
            "\"six.distance_m\"");
  EXPECT_EQ(diagnostic(replaced(good, "five.distance_m", "five.speed")),
            "s.toml:18: 'claims[0].measure': expected " + all_measures + "; not \"five.speed\"");
  EXPECT_EQ(diagnostic(replaced(good, "kind = \"difference\"", "kind = \"ratio\"")),
            "s.toml:13: 'claims[0].at_least': expected at_least, at_most or both for a ratio");
  EXPECT_EQ(diagnostic(replaced(good, "seconds = 300", "seconds = 300\nepisodes = 3")),
            "s.toml:13: 'tests[0].episodes' = 3: without noise all trials are the same");
  EXPECT_EQ(diagnostic(replaced(good, "seeds = [1, 2]", "seed = [1, 2]")),
            "s.toml:2: unknown key 'seed' (did you mean 'seeds'?)");
  EXPECT_EQ(diagnostic("name = \"s\"\nseeds = [1]\n"),
            "s.toml: no conditions: expected at least one [[conditions]]");
}

TEST(StudySpec, NumbersKeepToTheirRanges) {
  struct Case {
    const char *old, *key, *least, *most, *below, *beyond;
  };
  const auto with_key = [](const char* old, const std::string& key, const std::string& value) {
    return diagnostic(replaced(good, old, std::string(old) + "\n" + key + " = " + value));
  };
  const char* const claim = "against = \"b\"";
  const char* const condition = "config = \"a.toml\"";
  const char* const test = "name = \"five\"";
  for (const auto& [old, key, least, most, below, beyond] :
       {Case{claim, "alpha", "1e-9", "0.5", "0.99e-9", "0.51"},
        {claim, "sd", "0.0", "1e12", "-1e-9", "inf"},
        {claim, "mean", "-1e12", "1e12", "-inf", "inf"},
        {claim, "threshold", "-inf", "1e12", "nan", "inf"},
        {claim, "at_least", "-inf", "1e12", "nan", "inf"},
        {claim, "at_most", "-1e12", "inf", "-inf", "nan"},
        {claim, "runs", "0", "1000000000", "-1", "1000000001"},
        {claim, "successes", "0", "1000000000", "-1", "1000000001"},
        {claim, "from_generation", "0", "1000000000", "-1", "1000000001"},
        {condition, "generations", "0", "1000000000", "-1", "1000000001"},
        {condition, "seeds", "[0]", "[9007199254740992]", "[-1]", "[9007199254740993]"},
        {"name = \"s\"", "generations", "0", "1000000000", "-1", "1000000001"},
        {test, "reach_m", "0.0", "1e6", "-0.1", "1000000.1"},
        {test, "mutants", "0", "100000", "-1", "100001"}}) {
    for (const char* accepted : {least, most}) {
      const std::string found = with_key(old, key, accepted);
      EXPECT_TRUE(found.empty() || found.ends_with("does not use it")) << found;  // by claims of another kind
    }
    EXPECT_NE(with_key(old, key, below).find(key), std::string::npos) << key;
    EXPECT_NE(with_key(old, key, beyond).find(key), std::string::npos) << key;
  }
  const auto of_test = [](const std::string& key, const std::string& value) {
    const std::string more = key == "seconds" ? "" : "\nnoise = \"n.toml\"\nepisodes = " + value;
    return diagnostic(
        replaced(good, "seconds = 300", "seconds = " + (key == "seconds" ? value : "300") + more));
  };
  for (const char* accepted : {"1e-5", "1e6"}) EXPECT_EQ(of_test("seconds", accepted), "") << accepted;
  for (const char* refused : {"0.99e-5", "1000000.1"}) EXPECT_NE(of_test("seconds", refused), "") << refused;
  for (const char* accepted : {"1", "1000"}) EXPECT_EQ(of_test("episodes", accepted), "") << accepted;
  for (const char* refused : {"0", "1001"}) EXPECT_NE(of_test("episodes", refused), "") << refused;
}

TEST(StudySpec, TestsHaveSeveralEpisodesWhereNoiseOrGroundMakesThemDiffer) {
  const auto episodes = [](const std::string& more) {
    return diagnostic(replaced(good, "seconds = 300", "seconds = 300\nepisodes = 2\n" + more));
  };
  EXPECT_EQ(episodes("noise = \"n.toml\""), "");
  EXPECT_EQ(episodes("ground = \"n.toml\""), "");
  EXPECT_NE(episodes("damage = \"n.toml\"").find("without noise all trials are the same"), std::string::npos);
  EXPECT_EQ(diagnostic(replaced(good, "seconds = 300", "seconds = 300\nconditions = [\"b\", \"a\"]")), "");
  EXPECT_NE(diagnostic(replaced(good, "seconds = 300", "seconds = 300\nconditions = [\"b\", \"c\"]"))
                .find("'tests[0].conditions' names \"c\", which is none of the conditions"),
            std::string::npos);
}

TEST(StudySpec, LevelsOfDisturbanceAreKnownByNameAndTakeThePlaceOfNoise) {
  const std::string five = "seconds = 300\n";
  const auto with = [&five](const std::string& more) {
    return diagnostic(replaced(good, five, five + more));
  };
  EXPECT_EQ(with("level = \"milli\"\nepisodes = 16\n"), "");
  EXPECT_EQ(with("level = \"own\"\nepisodes = 16\n"), "");
  EXPECT_NE(with("level = \"mili\"\n").find("expected own, control, micro, 100-micro or milli"),
            std::string::npos);
  EXPECT_NE(with("level = \"milli\"\nnoise = \"n.toml\"\n").find("expected one of them"), std::string::npos);
}

TEST(StudySpec, EveryConditionHasAConfigSeedsAndAName) {
  EXPECT_NE(diagnostic(replaced(good, "config = \"a.toml\"", "")).find("'conditions[0].config' is missing"),
            std::string::npos);
  EXPECT_NE(diagnostic(replaced(good, "seeds = [1, 2]", "")).find("'seeds' is missing"), std::string::npos);
  EXPECT_NE(diagnostic(replaced(good, "seeds = [1, 2]", "seeds = []"))
                .find("or empty: expected a list of whole numbers"),
            std::string::npos);
  EXPECT_EQ(diagnostic(replaced(replaced(good, "seeds = [1, 2]", ""), "config = \"a.toml\"",
                                "config = \"a.toml\"\nseeds = [3]")),
            "")
      << "each condition has its own";
  EXPECT_NE(diagnostic(replaced(good, "seeds = [5]", "seeds = [5, 6, 5]"))
                .find("'conditions[1].seeds' has the seed 5"),
            std::string::npos);
  for (const char* name : {"a-z_09", "0", "_"})
    EXPECT_EQ(diagnostic(replaced(good, "name = \"five\"\nseconds = 300\n[[claims]]",
                                  std::string("name = \"five\"\nseconds = 300\n[[tests]]\nname = \"") + name +
                                      "\"\n[[claims]]")),
              "")
        << name;
  for (const char* name : {"A", "a b", "a.b", "`", "{", ":", "é"})
    EXPECT_NE(diagnostic(replaced(good, "name = \"five\"", std::string("name = \"") + name + "\""))
                  .find("expected 1 to 64 of a-z"),
              std::string::npos)
        << name;
}

TEST(StudySpec, ARobotIsAKeyOfItsConditionWhichAPathFromTheFileIs) {
  const std::string wrong = "expected 'robot' as a key of the condition, which is relative to the study file";
  EXPECT_NE(diagnostic(replaced(good, "seeds = [1, 2]", "seeds = [1, 2]\nsettings = [\"robot = r.toml\"]"))
                .find("s.toml:3: 'settings' has \"robot = r.toml\": " + wrong),
            std::string::npos);
  EXPECT_NE(
      diagnostic(replaced(good, "config = \"a.toml\"", "config = \"a.toml\"\nsettings = [\"robot=r.toml\"]"))
          .find("'conditions[0].settings' has \"robot=r.toml\": " + wrong),
      std::string::npos);
}

TEST(StudySpec, BoundsOfACountAreWholeNumbersOfRuns) {
  const auto counted = [](const std::string& bound) {
    return diagnostic(
        replaced(replaced(good, "kind = \"difference\"", "kind = \"count\"\nthreshold = 1\n" + bound),
                 "against = \"b\"\n", ""));
  };
  EXPECT_EQ(counted("at_least = 2"), "");
  EXPECT_NE(counted("at_least = 0.9").find("expected a whole number of runs for a count, not 0.9"),
            std::string::npos);
  EXPECT_NE(counted("at_most = 1.5").find("expected a whole number of runs for a count, not 1.5"),
            std::string::npos);
}

TEST(StudySpec, AConditionSwitchesBetweenGaitsOrIsSteeredByHand) {
  const std::string switching = "config = \"a.toml\"\ngaits = 3", steered = "\nsteering = \"turn_gain = 1\"";
  const auto with = [](const std::string& text) {
    return replaced(replaced(good, "config = \"a.toml\"", text), "seconds = 300",
                    "seconds = 300\ncommand = \"0.3,0\"");
  };
  EXPECT_EQ(diagnostic(with(switching)), "");
  EXPECT_NE(diagnostic(with(switching + steered)).find("'conditions[0].steering': champions that switch"),
            std::string::npos);
}

TEST(StudySpec, FilesOfConditionsAndTestsAreResolvedEachByItsOwnKey) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml",
                 replaced(replaced(good, "config = \"a.toml\"", "config = \"a.toml\"\nrobot = \"r.toml\""),
                          "seconds = 300",
                          "seconds = 300\nnoise = \"n.toml\"\nground = \"g.toml\"\ndamage = \"/d.toml\""));
  const StudySpec study = load_study(folder.path() / "s.toml");
  EXPECT_EQ(study.conditions[0].robot, (folder.path() / "r.toml").string());
  EXPECT_EQ(study.conditions[1].robot, "");
  EXPECT_EQ(study.tests[0].noise, (folder.path() / "n.toml").string());
  EXPECT_EQ(study.tests[0].ground, (folder.path() / "g.toml").string());
  EXPECT_EQ(study.tests[0].damage, "/d.toml");
}

TEST(StudySpec, DefaultsAreThoseOfAStudyThatSaysNothing) {
  const ClaimSpec claim;
  EXPECT_EQ(claim.kind, ClaimKind::difference);
  EXPECT_EQ(claim.measure, "train_m");
  EXPECT_EQ(claim.relation, Relation::greater);
  EXPECT_EQ(claim.test, TwoSampleTest::student);
  EXPECT_EQ(claim.alpha, 0.05);
  EXPECT_EQ(claim.at_least, -unbounded);
  EXPECT_EQ(claim.at_most, unbounded);
  EXPECT_EQ(claim.threshold, -unbounded);
  EXPECT_EQ(claim.mean, 0.0);
  EXPECT_EQ(claim.sd, 0.0);
  EXPECT_EQ(claim.runs, 0);
  EXPECT_EQ(claim.successes, 0);
  EXPECT_EQ(claim.from_generation, 0);
}

}  // namespace
}  // namespace amble::ledger
