#include "amble/ledger/claim_spec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/ledger/study_text.hpp"

namespace amble::ledger {
namespace {

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
  const test::TemporaryFolder folder;
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
      {"kind = 'count'\nthreshold = 1.0\nat_least = 2\nsuccesses = 3",
       "'claims[0].successes': expected at most 'runs', the number of runs that it is of"},
      {"kind = 'count'\nat_least = 2", threshold},
      {"kind = 'count'\nthreshold = 1.0\nthreshold_condition = 'b'\nat_least = 2", threshold},
      {"kind = 'count'\nthreshold_condition = 'c'\nat_least = 2",
       "'claims[0].threshold_condition': expected the name of a condition, not \"c\""},
      {"kind = 'count'\nthreshold = 1.0", bounds},
      {"kind = 'count'\nthreshold = 1.0\nat_least = 2\nruns = 5", bounds},
      {"kind = 'count'\nthreshold = 1.0\nat_most = 2\nruns = 5", bounds},
      {"kind = 'count'\nthreshold = 1.0\nruns = 5\nsuccesses = 6",
       "'claims[0].successes': expected at most 'runs', the number of runs that it is of"},
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

}  // namespace
}  // namespace amble::ledger
