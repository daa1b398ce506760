#include "amble/report/typical.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "amble/report/figures.hpp"
#include "amble/report/page.hpp"
#include "amble/report/tables.hpp"
#include "tests/figures/golden.hpp"
#include "tests/figures/xml.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A test of three trials at a level; the second falls. Median `distance_m`.
void add_levelled(StudyData& data, const std::string& level, double share, double seconds = 15.0,
                  const std::string& engine = "") {
  ledger::TestSpec test;
  test.name = level + (seconds == 15.0 ? "" : "-long") + engine;
  test.engine = engine;
  test.seconds = seconds;
  test.level = level;
  test.episodes = 3;
  data.study.tests.push_back(test);
  for (ledger::Record& run : data.records) {
    const double middle_m = share * run.best_objective;
    ledger::TestResult result;
    result.name = test.name;
    result.engine = engine.empty() ? "batch" : engine;
    result.trial_s = seconds;
    result.episodes = {{middle_m, seconds, seconds, record::Outcome::completed},
                       {0.1, 1.0, 1.0, record::Outcome::fell},
                       {9.0, seconds, seconds, record::Outcome::completed}};
    run.tests.push_back(result);
  }
}

/// small_study(), whose six runs keep half of their distance at micro and a quarter at milli.
StudyData levelled_study() {
  StudyData data = small_study();
  add_levelled(data, "milli", 0.25);
  add_levelled(data, "micro", 0.5);
  return data;
}

std::vector<std::string> names(const TypicalTable& table) {
  std::vector<std::string> found;
  for (const auto& column : table.columns) found.emplace_back(disturbance_name(column));
  return found;
}

TEST(Typical, GoesFromTheUndisturbedTrialToTheStrongestLevel) {
  const auto tables = typical_tables(levelled_study());
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_THAT(names(tables[0]), ElementsAre("none", "micro", "milli"));
  ASSERT_EQ(tables[0].curves.size(), 2u);
  const TypicalCurve& a = tables[0].curves[0];
  ASSERT_EQ(a.points.size(), 3u);
  EXPECT_DOUBLE_EQ(a.points[0].summary.median, 5.0);
  EXPECT_DOUBLE_EQ(a.points[1].summary.median, 2.5);
  EXPECT_DOUBLE_EQ(a.points[2].summary.median, 1.25);
  EXPECT_EQ(a.points[0].fell_share, std::nullopt);
  EXPECT_DOUBLE_EQ(a.points[1].fell_share.value(), 1.0 / 3.0);
  EXPECT_EQ(a.at(3), nullptr);
}

TEST(Typical, TakesEvolutionForTheUndisturbedTrialOnlyWhereItWasOne) {
  EXPECT_EQ(typical_tables(levelled_study())[0].curves[0].points[0].measure, "train_m");

  StudyData noisy = levelled_study();
  for (ledger::Record& run : noisy.records) run.champion["noise"] = {{"settings", {}}};
  EXPECT_THAT(names(typical_tables(noisy)[0]), ElementsAre("micro", "milli"));

  StudyData rough = levelled_study();
  rough.records.back().champion["ground"] = {{"kind", "rough"}};
  EXPECT_THAT(names(typical_tables(rough)[0]), ElementsAre("micro", "milli"));

  StudyData longer = levelled_study();
  for (ledger::Record& run : longer.records) run.champion["trial"]["duration_s"] = 20.0;
  EXPECT_THAT(names(typical_tables(longer)[0]), ElementsAre("micro", "milli"));

  StudyData tested = noisy;
  ledger::TestSpec plain;
  plain.name = "plain";
  plain.seconds = 15.0;
  tested.study.tests.push_back(plain);
  for (ledger::Record& run : tested.records)
    add_test(run, "plain", 2.0 * run.best_objective, 15.0, 15.0, 15.0);
  const auto table = typical_tables(tested)[0];
  EXPECT_THAT(names(table), ElementsAre("none", "micro", "milli"));
  EXPECT_DOUBLE_EQ(table.curves[0].points[0].summary.median, 10.0);
}

TEST(Typical, TakesEachConditionsOwnTestAtALevel) {
  StudyData data = levelled_study();
  ASSERT_GE(data.study.conditions.size(), 2u);
  const auto milli = std::ranges::find(data.study.tests, "milli", &ledger::TestSpec::name);
  ASSERT_NE(milli, data.study.tests.end());
  ledger::TestSpec other = *milli;
  other.name = "dear";
  other.episodes = 1;
  const std::string first = data.study.conditions[0].name, second = data.study.conditions[1].name;
  milli->conditions = {first};
  other.conditions = {second};
  data.study.tests.push_back(other);
  for (ledger::Record& run : data.records)
    if (run.condition == second)
      for (ledger::TestResult& test : run.tests)
        if (test.name == "milli") test.name = "dear";
  const auto tables = typical_tables(data);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_THAT(names(tables[0]), ElementsAre("none", "micro", "milli"));
  ASSERT_EQ(tables[0].curves.size(), 2u);
  EXPECT_EQ(tables[0].curves[0].points[2].measure, "milli.distance_m");
  EXPECT_EQ(tables[0].curves[1].points[2].measure, "dear.distance_m");
}

TEST(Typical, KeepsTestsOfAnotherLengthOrEngineApart) {
  StudyData data = levelled_study();
  add_levelled(data, "milli", 2.0, 300.0);
  add_levelled(data, "milli", 0.1, 15.0, "ode");
  const auto tables = typical_tables(data);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].name(), "typical-15s");
  EXPECT_EQ(tables[1].name(), "typical-300s");
  EXPECT_THAT(names(tables[1]), ElementsAre("none", "milli"));
  EXPECT_EQ(tables[1].curves[0].points[0].measure, "long.distance_m");
  EXPECT_EQ(tables[2].name(), "typical-15s-ode");
  EXPECT_EQ(tables[2].curves[0].points[0].measure, "ode.distance_m");
}

TEST(Typical, KeepsTestsWithACommandOrAGroundOfTheirOwnApartUnderNamesOfTheirOwn) {
  StudyData data = levelled_study();
  add_levelled(data, "100-micro", 0.4);
  add_levelled(data, "control", 1.0);
  data.study.tests[data.study.tests.size() - 2].command = "0.3,0";
  data.study.tests.back().ground = "rough.toml";
  const auto tables = typical_tables(data);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_THAT(names(tables[0]), ElementsAre("none", "micro", "milli"));
  EXPECT_THAT(names(tables[1]), ElementsAre("100-micro"));
  EXPECT_THAT(names(tables[2]), ElementsAre("control"));
  EXPECT_EQ(tables[0].name(), "typical-15s");
  EXPECT_EQ(tables[1].name(), "typical-15s-100-micro");
  EXPECT_EQ(tables[2].name(), "typical-15s-control");
}

TEST(Typical, IsOfConditionsThatHaveALevelAndOfRunsThatHaveTheTest) {
  StudyData data = levelled_study();
  for (ledger::TestSpec& test : data.study.tests)
    if (!test.level.empty()) test.conditions = {"b"};
  auto tables = typical_tables(data);
  ASSERT_EQ(tables.size(), 1u);
  ASSERT_EQ(tables[0].curves.size(), 1u);
  EXPECT_EQ(tables[0].curves[0].condition, "b");

  data = levelled_study();
  std::erase_if(data.records[0].tests, [](const auto& test) { return test.name == "milli"; });
  tables = typical_tables(data);
  EXPECT_EQ(tables[0].curves[0].points[1].summary.n, 3u);
  EXPECT_EQ(tables[0].curves[0].points[2].summary.n, 2u);
  EXPECT_TRUE(typical_tables(small_study()).empty());
}

TEST(Typical, HasASectionAFigureAndRowsOfATableWhereThereAreLevels) {
  const Report report = make_report(levelled_study());
  const std::string html = make_page(report);
  EXPECT_NO_THROW(tests::parse_xml(html));
  EXPECT_THAT(html, HasSubstr("What a walker typically does"));
  EXPECT_THAT(html, HasSubstr("fell: 33\u00a0%"));
  EXPECT_THAT(make_page(make_report(small_study())), Not(HasSubstr("typically does")));

  const auto all = tables(report);
  const auto& table = *std::ranges::find(all, "typical", &Table::name);
  ASSERT_EQ(table.rows.size(), 6u) << "two conditions, three sizes of disturbance";
  EXPECT_EQ(table.rows[2][2], Cell("milli"));
  EXPECT_EQ(table.rows[2][10], Cell(1.25));

  std::map<std::string, std::string> made;
  for (const FigureFile& figure : figure_files(report))
    if (figure.name.starts_with("typical")) made[figure.name] = figure.svg;
  tests::expect_golden(made, {{"typical-15s.svg", "bd87033254b9045f"}});
}

}  // namespace
}  // namespace amble::report
