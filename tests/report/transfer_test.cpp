#include "amble/report/transfer.hpp"

#include <gtest/gtest.h>

#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

TEST(Transfers, CompareWithTheSameLengthAtHome) {
  StudyData data = small_study();
  auto found = transfers(data);
  ASSERT_EQ(found.size(), 2u) << "test ode in both conditions";
  EXPECT_EQ(found[0].reference, "train_m");
  EXPECT_EQ(found[0].engine, "ode");
  EXPECT_DOUBLE_EQ(*found[0].share, 0.5);
  EXPECT_DOUBLE_EQ(found[0].median_m, 2.5);

  data.study.tests.push_back(data.study.tests[0]);
  data.study.tests.back().name = "long-ode";
  for (ledger::Record& run : data.records)
    add_test(run, "long-ode", 1.5 * run.best_m, 300.0, 300.0, 300.0, "trot", "ode");
  found = transfers(data);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[2].test, "long-ode");
  EXPECT_EQ(found[2].reference, "long.distance_m");
  EXPECT_DOUBLE_EQ(*found[2].share, 0.5) << "of 3 × the distance in evolution";
}

TEST(Transfers, WithoutAReferenceHaveNoShare) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records) run.champion = io::Json::object();
  EXPECT_FALSE(transfers(data)[0].share) << "how long evolution’s trials were is unknown";
  data = small_study();
  data.study.tests[1].noise = "noise.toml";
  EXPECT_FALSE(transfers(data)[0].share) << "there is no such noise at home";
}

TEST(Transfers, AreOnlyTestsInOtherEngines) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records) run.engine = "ode";
  for (const Transfer& transfer : transfers(data)) EXPECT_EQ(transfer.test, "long");
}

}  // namespace
}  // namespace amble::report
