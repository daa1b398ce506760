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

const std::string all_measures =
    "train_m, hidden, links, coverage, qd_score, map_best, entering_share, with map_trials "
    "corrected_coverage, corrected_qd_score, staying_share, TEST.distance_m, .upright_s, "
    ".walking_s, .moving_s, .kept, with episodes .lower_quartile_m, .upper_quartile_m, .best_m, .fell_share, "
    "with reach_m .reached_s, .reached_generation, .reached_evaluations, with mutants .viable_share, "
    ".mutants_kept, .gait_change, with command .tracking, .speed_error, .turn_error, .switch_s, "
    "with energy .cost_of_transport, with seam .jumps, .jump_rad, .jump_power_w";

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

/// The diagnostic for the good study with this claim about the condition "a" instead of its own.
std::string claim_diagnostic(const std::string& claim, const std::string& measure = "five.distance_m") {
  const std::string text = good;
  return diagnostic(text.substr(0, text.find("[[claims]]")) +
                    "[[claims]]\ntext = \"Claim.\"\ncondition = \"a\"\nmeasure = \"" + measure + "\"\n" +
                    claim);
}

struct ClaimCase {
  const char* claim;
  std::string diagnostic;  ///< without its place; "": accepted
};

void expect_diagnostics(const std::vector<ClaimCase>& cases) {
  for (const auto& [claim, expected] : cases) {
    const std::string found = claim_diagnostic(claim);
    const std::size_t place = found.find("'claims[0].");
    EXPECT_EQ(place == std::string::npos ? found : found.substr(place), expected) << claim;
  }
}

TEST(ClaimSpec, OfARatioHasOneDenominatorAndABound) {
  const char* const denominator =
      "'claims[0].against': expected either 'against' (a condition) or 'base_measure' for a ratio";
  expect_diagnostics({
      {"kind = 'ratio'\nagainst = 'b'\nat_least = 2.0", ""},
      {"kind = 'ratio'\nagainst = 'b'\nat_most = 2.0", ""},
      {"kind = 'ratio'\nbase_measure = 'train_m'\nat_least = 1.0\nat_most = 2.0", ""},
      {"kind = 'ratio'\nat_least = 2.0", denominator},
      {"kind = 'ratio'\nagainst = 'b'\nbase_measure = 'train_m'\nat_least = 2.0", denominator},
      {"kind = 'ratio'\nagainst = 'c'\nat_least = 2.0",
       "'claims[0].against': expected the name of a condition, not \"c\""},
      {"kind = 'ratio'\nbase_measure = 'speed'\nat_least = 2.0",
       "'claims[0].base_measure': expected " + all_measures + "; not \"speed\""},
      {"kind = 'ratio'\nbase_measure = 'train_m'",
       "'claims[0].at_least': expected at_least, at_most or both for a ratio"},
  });
}

TEST(ClaimSpec, ThatNoOutcomeCouldMeetIsRefused) {
  expect_diagnostics({
      {"kind = 'ratio'\nagainst = 'b'\nat_least = 2.0\nat_most = 2.0", ""},
      {"kind = 'ratio'\nagainst = 'b'\nat_least = 2.5\nat_most = 2.0",
       "'claims[0].at_least': expected at most 'at_most' = 2, not 2.5"},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 3\nat_most = 2",
       "'claims[0].at_least': expected at most 'at_most' = 2, not 3"},
      {"kind = 'ratio'\nagainst = 'a'\nat_least = 0.5",
       "'claims[0].against': expected another condition than 'condition', not \"a\" again"},
      {"kind = 'difference'\nagainst = 'a'",
       "'claims[0].against': expected another condition than 'condition', not \"a\" again"},
  });
}

TEST(ClaimSpec, SaysNothingThatItsKindDoesNotUse) {
  const auto unused = [](const std::string& key, const std::string& kind) {
    return "'claims[0]." + key + "': expected nothing: a claim of kind \"" + kind + "\" does not use it";
  };
  expect_diagnostics({
      {"kind = 'difference'\nagainst = 'b'\nat_least = 2.0", unused("at_least", "difference")},
      {"kind = 'difference'\nagainst = 'b'\nthreshold = 2.0", unused("threshold", "difference")},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 3\nagainst = 'b'", unused("against", "count")},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 3\nalpha = 0.01", unused("alpha", "count")},
      {"kind = 'plateau'\nat_least = 0.0\nat_most = 0.1\nfrom_generation = 1", unused("at_least", "plateau")},
      {"kind = 'value'\nmean = 3.0\nsd = 1.0\nruns = 2\nsuccesses = 1", unused("successes", "value")},
      {"kind = 'ratio'\nagainst = 'b'\nat_most = 2.0\ntest = 'welch'", unused("test", "ratio")},
  });
}

TEST(ClaimSpec, OfAStudyThatIsRecordedMayHaveWhatEarlierVersionsLetItHave) {
  const TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml",
                 replaced(good, "kind = \"difference\"", "kind = \"difference\"\nat_least = 2.0"));
  EXPECT_THROW(load_study(folder.path() / "s.toml"), UserError);
  EXPECT_EQ(load_study(folder.path() / "s.toml", true).claims[0].at_least, 2.0);
}

TEST(ClaimSpec, IsAboutConditionsThatItsTestTries) {
  const std::string some = replaced(good, "seconds = 300", "seconds = 300\nconditions = [\"b\"]");
  EXPECT_EQ(diagnostic(some),
            "s.toml:17: 'claims[0].condition': expected a condition that test 'five' tries (its "
            "'conditions'), not \"a\"");
  EXPECT_NE(diagnostic(replaced(some, "[\"b\"]", "[\"a\"]"))
                .find("'claims[0].against': expected a condition that test"),
            std::string::npos);
}

TEST(ClaimSpec, OfGaitsNamesGaitsThatThereAre) {
  const auto gaits = [](const std::string& names) {
    return claim_diagnostic("kind = 'gaits'\n" + names, "five");
  };
  const std::string known =
      "walk lateral, walk diagonal, trot, pace, bound, pronk, gallop, tripod, tetrapod, wave, walk, run, hop";
  EXPECT_EQ(gaits("includes = ['walk', 'walk lateral', 'trot']\nonly = ['hop', 'tripod']"), "");
  EXPECT_EQ(gaits("includes = ['trot', 'canter']"),
            "s.toml:18: 'claims[0].includes': expected " + known + "; not \"canter\"");
  EXPECT_EQ(gaits("only = ['irregular']"),
            "s.toml:18: 'claims[0].only': expected " + known + "; not \"irregular\"");
  EXPECT_NE(gaits("only = [\"tr\\not\"]").find("; not \"tr\\x0aot\""), std::string::npos);
}

TEST(ClaimSpec, WhatItNamesStaysInOneLine) {
  expect_diagnostics({
      {"kind = 'difference'\nagainst = \"b\\nc\"",
       "'claims[0].against': expected the name of a condition, not \"b\\x0ac\""},
      {"kind = 'ratio'\nbase_measure = \"b\\nc\"\nat_least = 2.0",
       "'claims[0].base_measure': expected " + all_measures + "; not \"b\\x0ac\""},
  });
}

TEST(ClaimSpec, OfACountHasOneThresholdAndEitherBoundsOrAPublishedCount) {
  const char* const threshold =
      "'claims[0].threshold': expected either 'threshold' or 'threshold_condition' for a count";
  const char* const bounds =
      "'claims[0].at_least': expected either bounds (at_least, at_most) or a published count (successes, "
      "runs)";
  expect_diagnostics({
      {"kind = 'count'\nthreshold = 1.0\nat_least = 2", ""},
      {"kind = 'count'\nthreshold = 1.0\nat_most = 2", ""},
      {"kind = 'count'\nthreshold_condition = 'b'\nruns = 5\nsuccesses = 5", ""},
      {"kind = 'count'\nthreshold = 1.0\nruns = 1", ""},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 2\nsuccesses = 3", ""},
      {"kind = 'count'\nat_least = 2", threshold},
      {"kind = 'count'\nthreshold = 1.0\nthreshold_condition = 'b'\nat_least = 2", threshold},
      {"kind = 'count'\nthreshold_condition = 'c'\nat_least = 2",
       "'claims[0].threshold_condition': expected the name of a condition, not \"c\""},
      {"kind = 'count'\nthreshold = 1.0", bounds},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 2\nruns = 5", bounds},
      {"kind = 'count'\nthreshold = 1.0\nat_most = 2\nruns = 5", bounds},
      {"kind = 'count'\nthreshold = 1.0\nruns = 5\nsuccesses = 6",
       "'claims[0].successes': expected at most 'runs'"},
  });
}

TEST(ClaimSpec, OfEachOtherKindHasWhatItsRuleNeeds) {
  const char* const spread = "'claims[0].sd': expected sd > 0 and runs > 1";
  const char* const plateau = "'claims[0].at_most': expected at_most and from_generation for a plateau";
  expect_diagnostics({
      {"kind = 'difference'\nagainst = 'b'", ""},
      {"kind = 'difference'", "'claims[0].against': expected the name of a condition, not \"\""},
      {"kind = 'difference'\nagainst = 'b'\nrelation = 'not_less'\nmargin = 0.5", ""},
      {"kind = 'difference'\nagainst = 'b'\nmargin = 0.5",
       "'claims[0].margin': expected 0 unless relation = \"not_less\""},
      {"kind = 'difference'\nagainst = 'b'\nrelation = 'not_less'\ntest = 'mann_whitney'\nmargin = 0.5",
       "'claims[0].margin': expected 0 for ranks: test = \"student\" or \"welch\" have a margin"},
      {"kind = 'value'\nmean = 3.0\nsd = 1e-9\nruns = 2", ""},
      {"kind = 'value'\nmean = 3.0\nsd = 0.0\nruns = 2", spread},
      {"kind = 'value'\nmean = inf\nsd = 1.0\nruns = 2",
       "'claims[0].mean' = inf: expected a number from -1000000000000 to 1000000000000"},
      {"kind = 'value'\nmean = 3.0\nsd = inf\nruns = 2",
       "'claims[0].sd' = inf: expected a number from 0 to 1000000000000"},
      {"kind = 'count'\nthreshold = inf\nat_least = 2",
       "'claims[0].threshold' = inf: expected a number from -inf to 1000000000000"},
      {"kind = 'value'\nmean = 3.0\nsd = 1.0\nruns = 1", spread},
      {"kind = 'plateau'\nat_most = 0.1\nfrom_generation = 1", ""},
      {"kind = 'plateau'\nat_most = 0.1", plateau},
      {"kind = 'plateau'\nfrom_generation = 1", plateau},
      {"kind = 'gaits'\nincludes = ['trot']",
       "'claims[0].measure': expected the name of a test (five), not \"five.distance_m\""},
  });
  const auto gaits = [](const std::string& names) {
    return claim_diagnostic("kind = 'gaits'" + names, "five");
  };
  EXPECT_EQ(gaits("\nincludes = ['trot']"), "");
  EXPECT_EQ(gaits("\nonly = ['trot']"), "");
  EXPECT_NE(gaits("").find("'claims[0].includes': expected names of gaits here or in 'only'"),
            std::string::npos);
  EXPECT_NE(diagnostic(replaced(good, "A beats B.", "")).find("'claims[0].text': expected a sentence"),
            std::string::npos);
  EXPECT_NE(diagnostic(replaced(good, "condition = \"a\"", "condition = \"d\""))
                .find("'claims[0].condition': expected the name of a condition, not \"d\""),
            std::string::npos);
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
