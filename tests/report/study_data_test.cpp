#include "amble/report/study_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/ledger/ledger.hpp"
#include "amble/report/tables.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(StudyData, ComesFromTheFolderAlone) {
  const test::TemporaryFolder folder;
  const ledger::StudyPaths paths(std::filesystem::path(folder / "study"));
  EXPECT_THROW(load_study_data(paths.folder), UserError);
  const StudyData data = small_study();
  ledger::keep_study(paths, data.study);
  EXPECT_TRUE(load_study_data(paths.folder).records.empty());
  for (const ledger::Record& run : data.records) ledger::Ledger(paths).save(run);
  const StudyData loaded = load_study_data(paths.folder);
  EXPECT_EQ(loaded.records.size(), 6u);
  EXPECT_EQ(loaded.planned(), 6u);
  EXPECT_THAT(loaded.values("a", "long.distance_m"), ElementsAre(12.0, 15.0, 18.0));
  EXPECT_EQ(ledger::ledger_digest(loaded.study, loaded.records),
            ledger::ledger_digest(data.study, data.records));
}

TEST(StudyData, HasMeasuresOfTheFirstWalkerOfTestsThatAskForADistance) {
  StudyData data = small_study();
  const std::vector<std::string> of_test{"distance_m", "upright_s", "walking_s", "moving_s", "kept"};
  std::vector<std::string> expected{"train_m", "hidden", "links"};
  for (const char* test : {"long", "ode"})
    for (const std::string& what : of_test) expected.push_back(std::string(test).append(".").append(what));
  EXPECT_EQ(measures_of(data), expected);
  data.study.tests[1].reach_m = 1.0;
  for (const std::string what : {"reached_s", "reached_generation", "reached_evaluations"})
    expected.push_back("ode." + what);
  EXPECT_EQ(measures_of(data), expected);
}

TEST(StudyData, ComparesViableMutantsAndTheirGaitsOfTestsThatHaveMutants) {
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const bool with : {false, true}) {
    const StudyData data = with ? mutated_study() : small_study();
    for (const char* name : {"long.viable_share", "long.gait_change"}) {
      EXPECT_EQ(has(measures_of(data), name), with) << name;
      EXPECT_EQ(has(compared_measures_of(data), name), with) << name;
    }
    EXPECT_EQ(has(measures_of(data), "long.mutants_kept"), with);
    EXPECT_FALSE(has(measures_of(data), "ode.viable_share"));
  }
  EXPECT_NEAR(mutated_study().values("a", "long.viable_share").at(0), 4.0 / 6.0, 1e-12);
}

TEST(StudyData, HasMeasuresOfMapsThatSomeRunsHave) {
  StudyData data = small_study();
  const std::size_t without = measures_of(data).size(), compared = compared_measures_of(data).size();
  data.records[1].map_figures = {{"coverage", 0.5}, {"qd_score", 7.0}};
  data.records[4].map_figures = {{"coverage", 0.25}, {"map_best", 2.0}};
  const auto all = measures_of(data), some = compared_measures_of(data);
  EXPECT_EQ(all.size(), without + 3);
  EXPECT_EQ(some.size(), compared + 3);
  for (const char* figure : {"coverage", "map_best", "qd_score"}) {
    EXPECT_THAT(all, testing::Contains(figure).Times(1));
    EXPECT_THAT(some, testing::Contains(figure).Times(1));
  }
  EXPECT_THAT(data.values("a", "coverage"), ElementsAre(0.5));
  for (const std::string& measure : some) EXPECT_THAT(all, testing::Contains(measure));
}

TEST(Remarks, AreNoneOfAFinishedStudy) {
  EXPECT_THAT(remarks(small_study()), IsEmpty());
}

TEST(Remarks, TellOfConditionsThatGaveTheSameChampionsWithTheSameSeeds) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records) run.champion["genome"] = {{"nodes", run.seed}};
  EXPECT_THAT(remarks(data), ElementsAre(HasSubstr("Conditions a and b gave the same champions")));
  data.records.back().champion["genome"] = {{"nodes", "another"}};
  EXPECT_THAT(remarks(data), IsEmpty());
}

TEST(Remarks, TellWhatIsMissing) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1);
  data.records[0].tests.pop_back();
  EXPECT_THAT(remarks(data), ElementsAre(HasSubstr("5 of 6 runs are in (a: 2 of 3)"),
                                         "Test ode: 1 finished run does not have it yet."));
}

TEST(StudyData, IsOfADistanceOrInMetresIfAllRunsAre) {
  const record::Objective distance, metres{.is_distance = false, .unit = " m", .title = "Score"},
      score{.is_distance = false, .unit = "", .title = "Score"};
  EXPECT_EQ(small_study().objective(), distance);
  EXPECT_EQ(scored_study("heading").objective(), metres);
  EXPECT_EQ(scored_study("economy").objective(), score);
  StudyData mixed = small_study();
  mixed.records[4] = scored_study("economy").records[4];
  EXPECT_EQ(mixed.objective(), score);
  mixed.records[4] = scored_study("heading").records[4];
  EXPECT_EQ(mixed.objective(), metres);
  EXPECT_EQ(mixed.unit_of("train_m"), " m");
  EXPECT_EQ(scored_study("economy").unit_of("train_m"), "");
  EXPECT_EQ(scored_study("economy").unit_of("long.distance_m"), " m");
}

TEST(StudyData, LeavesOutTestsThatTheStudyNoLongerHasForACondition) {
  StudyData data = mutated_study();
  data.study.tests[0].conditions = {"b"};
  data.study.tests.pop_back();
  EXPECT_THAT(remarks(data), IsEmpty());
  EXPECT_EQ(data.result(data.records[0], "long"), nullptr);
  EXPECT_EQ(data.result(data.records[3], "long"), &data.records[3].tests[0]);
  EXPECT_EQ(data.result(data.records[3], "ode"), nullptr);
  EXPECT_THAT(data.values("a", "long.distance_m"), IsEmpty());
  EXPECT_THAT(data.values("b", "ode.distance_m"), IsEmpty());
  EXPECT_THAT(data.values("b", "long.distance_m"), ElementsAre(3.0, 7.5, 6.0));

  data.study.claims.clear();
  const Report report = make_report(data);
  EXPECT_THAT(report.transfers, IsEmpty());
  ASSERT_EQ(report.gaits.size(), 1u);
  EXPECT_EQ(report.gaits[0].rows.size(), 1u);
  for (const SurvivalTable& table : report.survival) {
    EXPECT_EQ(table.test, "long");
    EXPECT_EQ(table.conditions.size(), 1u);
  }
  for (const Table& table : tables(report)) {
    if (table.name == "mutants") {
      EXPECT_EQ(table.rows.size(), 18u) << "6 of each run of b";
    }
    if (table.name != "runs") continue;
    const auto gait = to_index(std::ranges::find(table.header, "long.gait") - table.header.begin());
    const auto distance = to_index(std::ranges::find(table.header, "long.distance_m") - table.header.begin());
    for (const std::size_t column : {gait, distance}) {
      EXPECT_TRUE(std::holds_alternative<std::monostate>(table.rows[0].at(column)));
      EXPECT_FALSE(std::holds_alternative<std::monostate>(table.rows[3].at(column)));
    }
  }
}

TEST(Remarks, TellOfTestsBySeveralSettings) {
  StudyData data = small_study();
  data.records[1].tests[0].settings = "other";
  for (std::size_t i : {3u, 4u, 5u}) data.records[i].tests[1].settings = "own";
  EXPECT_THAT(remarks(data),
              ElementsAre("Test long: runs of a were tested with different settings; they are no "
                          "sample of one test."));
}

TEST(Remarks, TellOfRecordsOfOtherStudies) {
  StudyData data = small_study();
  data.records[1].study = "elsewhere";
  data.study.name = "sam\nple";
  EXPECT_THAT(remarks(data), ElementsAre("6 of 6 records are of a study of another name than sam\\x0aple."));
  data.study.name = "sample";
  EXPECT_THAT(remarks(data), ElementsAre("1 of 6 records are of a study of another name than sample."));
}

TEST(Remarks, NameUnknownFilesInOneLine) {
  const test::TemporaryFolder folder;
  const ledger::StudyPaths paths(std::filesystem::path(folder / "study"));
  const StudyData data = small_study();
  ledger::keep_study(paths, data.study);
  ledger::Ledger(paths).save(data.records[0]);
  std::filesystem::copy(paths.record("a", 1), paths.records / "two\nlines.json");
  EXPECT_THAT(load_study_data(paths.folder).unknown_files, ElementsAre("two\\x0alines.json"));
}

TEST(Remarks, TellOfScoresThatDiffer) {
  EXPECT_THAT(remarks(scored_study("economy")), IsEmpty());
  StudyData mixed = small_study();
  mixed.records[4] = scored_study("economy").records[4];
  EXPECT_THAT(remarks(mixed), ElementsAre(HasSubstr("different scores")));
}

TEST(Remarks, TellWhatDoesNotFit) {
  StudyData data = small_study();
  data.records[1].config = "another";
  data.records[4].generations = 12;
  data.records[5].tests[0].trial_s = 200.0;
  data.records[5].provenance.claims = "others";
  data.unknown_files = {"x-001.json"};
  EXPECT_THAT(remarks(data), ElementsAre(HasSubstr("a: runs differ in their settings"),
                                         HasSubstr("b: runs differ in their number of generations"),
                                         HasSubstr("trials of 200 s, the study asks for 300 s"),
                                         HasSubstr("1 of 6 records were made when they were others"),
                                         HasSubstr("x-001.json")));
}

}  // namespace
}  // namespace amble::report
