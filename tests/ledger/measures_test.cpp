#include "amble/ledger/measures.hpp"

#include <gtest/gtest.h>

#include "amble/ledger/study_spec.hpp"
#include "tests/ledger/samples.hpp"

namespace amble::ledger {
namespace {

TEST(Measures, AreTakenFromTheRunOrFromANamedTest) {
  const Record record = sample_record();
  EXPECT_EQ(measure(record, "train_m"), 4.25);
  EXPECT_EQ(measure(record, "hidden"), 3.0);
  EXPECT_EQ(measure(record, "links"), 21.0);
  EXPECT_EQ(measure(record, "five.distance_m"), 12.5);
  EXPECT_EQ(measure(record, "five.upright_s"), 300.0);
  EXPECT_EQ(measure(record, "five.walking_s"), 250.0);
  EXPECT_EQ(measure(record, "noisy.kept"), 3.0 / 4.25);
}

TEST(Measures, OfATestThatWasNotMadeIsNothing) {
  EXPECT_EQ(measure(sample_record(), "ten.distance_m"), std::nullopt);
  EXPECT_EQ(measure(sample_record(), "five.height_m"), std::nullopt);
  EXPECT_EQ(measure(sample_record(), "height_m"), std::nullopt);
}

TEST(Measures, ShareKeptOfNoDistanceIsZero) {
  Record record = sample_record();
  record.best_m = 0.0;
  EXPECT_EQ(measure(record, "five.kept"), 0.0);
}

TEST(Measures, OfMutantsAreTakenFromThoseOfTheTest) {
  Record record = sample_record();
  record.tests[0].mutants = {{0.2, 0.5}, {0.5, 0.125}, {0.7, 0.25}, {0.49, 0.5}, {1.1, 0.75}};
  EXPECT_EQ(measure(record, "five.viable_share"), 0.6);
  EXPECT_EQ(measure(record, "five.mutants_kept"), 0.5);
  EXPECT_EQ(measure(record, "five.gait_change"), 0.375);
  EXPECT_EQ(measure(record, "noisy.viable_share"), std::nullopt);
  record.tests[0].mutants = {{0.2, 0.5}};
  EXPECT_EQ(measure(record, "five.gait_change"), 0.0);
}

TEST(Measures, OfMutantsAreKnownOfTestsThatHaveThem) {
  StudySpec study;
  study.tests.emplace_back().name = "five";
  EXPECT_FALSE(is_measure(study, "five.viable_share"));
  study.tests[0].mutants = 10;
  EXPECT_TRUE(is_measure(study, "five.viable_share"));
  EXPECT_TRUE(is_measure(study, "five.walking_s"));
  EXPECT_FALSE(is_measure(study, "five.reached_s"));
}

TEST(Measures, AreKnownByTheStudysTests) {
  StudySpec study;
  study.tests.emplace_back().name = "five";
  EXPECT_TRUE(is_measure(study, "train_m"));
  EXPECT_TRUE(is_measure(study, "five.walking_s"));
  EXPECT_FALSE(is_measure(study, "ten.walking_s"));
  EXPECT_FALSE(is_measure(study, "five.depth"));
  EXPECT_FALSE(is_measure(study, "walking_s"));
}

}  // namespace
}  // namespace amble::ledger
