#include "amble/report/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "amble/report/curves_figure.hpp"
#include "amble/report/mutants_figure.hpp"
#include "amble/report/survival_figure.hpp"
#include "tests/figures/xml.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using figures::FigureSize;
using tests::parse_xml;
using tests::with_class;

TEST(Beeswarm, KeepsPointsApartWhereThereIsRoom) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> places(20);
    for (double& place : places) place = static_cast<double>(random() % 3000) / 10.0;
    const auto offsets = beeswarm(places, 2.0, 40.0);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GE(std::hypot(places[i] - places[k], offsets[i] - offsets[k]), 4.0);
    EXPECT_EQ(offsets, beeswarm(places, 2.0, 40.0));
  }
}

TEST(Beeswarm, StaysWithinItsStrip) {
  for (const double offset : beeswarm(std::vector<double>(50, 7.0), 2.6, 8.0))
    EXPECT_LE(std::abs(offset), 8.0);
}

/// The scale of a figure of rows, from its ticks.
double px_per_unit(const std::vector<tests::XmlElement>& elements) {
  std::vector<const tests::XmlElement*> ticks;
  for (const auto& element : elements)
    if (element.name == "text" && element.attributes.count("class") &&
        element.attributes.at("class") == "tick" && element.attributes.at("text-anchor") == "middle")
      ticks.push_back(&element);
  return (ticks.back()->number("x") - ticks.front()->number("x")) /
         (std::stod(ticks.back()->text) - std::stod(ticks.front()->text));
}

TEST(RowsFigure, DrawsMeansIntervalsAndRunsToScale) {
  const Report report = make_report(small_study());
  const auto rows = training_rows(report);
  ASSERT_EQ(rows.size(), 2u);
  for (const auto layout : {FigureSize::wide, FigureSize::narrow}) {
    const auto elements = parse_xml(rows_figure(rows, " m", "distances", layout));
    const double scale = px_per_unit(elements);
    const auto bars = with_class(elements, "bar"), runs = with_class(elements, "run"),
               whiskers = with_class(elements, "whisker");
    ASSERT_EQ(bars.size(), 2u);
    ASSERT_EQ(runs.size(), 6u);
    ASSERT_EQ(whiskers.size(), 6u);
    const double zero = bars[0].number("x");
    EXPECT_NEAR(bars[0].number("width"), 5.0 * scale, 0.02);
    EXPECT_NEAR(runs[0].number("cx"), zero + 4.0 * scale, 0.02);
    EXPECT_NEAR(whiskers[0].number("x1"), zero + rows[0].strips[0].interval->lower * scale, 0.02);
    EXPECT_NEAR(whiskers[0].number("x2"), zero + rows[0].strips[0].interval->upper * scale, 0.02);
  }
}

TEST(RowsFigure, HasRoomForIntervalsThatReachBeyondAllRuns) {
  auto rows = training_rows(make_report(small_study()));
  for (const auto& interval : {statistics::Interval{-40.0, 9.0}, {3.0, 90.0}, {-40.0, 90.0}}) {
    rows[0].strips[0].interval = interval;
    for (const auto layout : {FigureSize::wide, FigureSize::narrow}) {
      const auto elements = parse_xml(rows_figure(rows, " m", "distances", layout));
      const auto bar = with_class(elements, "bar")[0];
      const double scale = bar.number("width") / rows[0].strips[0].mean.value(), zero = bar.number("x");
      const auto whisker = with_class(elements, "whisker")[0];
      EXPECT_NEAR(whisker.number("x1"), zero + interval.lower * scale, 0.2);
      EXPECT_NEAR(whisker.number("x2"), zero + interval.upper * scale, 0.2);
      EXPECT_GE(whisker.number("x1"), 0.0);
      EXPECT_LE(whisker.number("x2"), elements[0].number("width"));
    }
  }
}

TEST(RowsFigure, OfATestHasEvolutionBesideIt) {
  const Report report = make_report(small_study());
  const auto rows = test_rows(report, "long");
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows[0].strips.size(), 2u);
  EXPECT_EQ(rows[0].strips[0].mean, 5.0);
  EXPECT_EQ(rows[0].strips[1].mean, 15.0);
}

/// Every text is within the picture, by a generous estimate of its width.
void expect_inside(const std::string& svg) {
  const auto elements = parse_xml(svg);
  const double width = elements[0].number("width"), height = elements[0].number("height");
  for (const auto& element : elements) {
    if (element.name != "text") continue;
    EXPECT_GE(element.number("x"), 0.0) << element.text;
    EXPECT_LE(element.number("x"), width) << element.text;
    EXPECT_GE(element.number("y"), 4.0) << element.text;
    EXPECT_LE(element.number("y"), height + 1.0) << element.text;
  }
}

TEST(Figures, HoldTheirTextsWithTwoConditionsOrTwenty) {
  for (const int count : {2, 4, 8, 9, 20}) {
    const Report report = make_report(large_study(count, 3));
    for (const auto layout : {FigureSize::wide, FigureSize::narrow}) {
      expect_inside(rows_figure(training_rows(report), " m", "", layout));
      expect_inside(rows_figure(test_rows(report, "long"), " m", "", layout));
      expect_inside(curves_figure(report, layout));
      for (const SurvivalTable& table : report.survival)
        expect_inside(survival_figure(report, table, layout));
    }
  }
}

TEST(SurvivalFigure, ShowsEachConditionsCurveOnceWhetherOverlaidOrInPanelsBeforeTheOthers) {
  for (const int count : {1, 2, 4, 5, 8, 9, 20}) {
    const Report report = make_report(large_study(count, 3));
    ASSERT_FALSE(report.survival.empty());
    for (const SurvivalTable& table : report.survival)
      for (const auto layout : {FigureSize::wide, FigureSize::narrow}) {
        const auto elements = parse_xml(survival_figure(report, table, layout));
        const auto others = with_class(elements, "other").size();
        const auto conditions = static_cast<std::size_t>(count);
        std::vector<std::string> shown, expected;
        for (const auto& element : elements)
          if (element.name == "title" && element.text.find(" at the end") != std::string::npos)
            shown.push_back(element.text.substr(0, element.text.find(':')));
        for (const auto& condition : table.conditions) expected.push_back(report.label(condition.condition));
        EXPECT_EQ(shown, expected);
        EXPECT_EQ(expected.size(), conditions);
        EXPECT_EQ(others, count <= figures::leg_colours ? 0 : conditions * (conditions - 1));
      }
  }
}

TEST(CurvesFigure, GoesAroundTheBandBetweenTheQuartilesOnce) {
  const Report report = make_report(small_study());
  const auto bands = with_class(parse_xml(curves_figure(report, FigureSize::wide)), "band");
  ASSERT_EQ(bands.size(), report.curves.size());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const auto corners = tests::points(bands[b]);
    const std::size_t count = report.curves[b].generation.size();
    ASSERT_EQ(corners.size(), 2 * count);
    ASSERT_GE(count, 2u);
    for (std::size_t i = 0; i < count; ++i) {
      // Out along the upper quartiles and back along the lower ones.
      EXPECT_EQ(corners[i].first, corners[2 * count - 1 - i].first) << i;
      EXPECT_LE(corners[i].second, corners[2 * count - 1 - i].second) << i;
      if (i > 0) {
        EXPECT_LT(corners[i - 1].first, corners[i].first) << i;
      }
    }
  }
}

TEST(CurvesFigure, DrawsTheOthersToTheirLastGenerationHoweverManyThereAre) {
  for (const int generations : {7, 62, 63, 64}) {
    Report report = make_report(small_study());
    for (BestCurve& curve : report.curves) {
      curve.generation.resize(static_cast<std::size_t>(generations));
      std::iota(curve.generation.begin(), curve.generation.end(), 0);
      for (auto* values : {&curve.median_m, &curve.lower_quartile_m, &curve.upper_quartile_m})
        values->resize(curve.generation.size(), 1.0);
    }
    const auto elements = parse_xml(curves_figure(report, FigureSize::wide));
    const auto others = with_class(elements, "other"), curves = with_class(elements, "curve");
    ASSERT_FALSE(others.empty());
    std::set<double> ends, other_ends;
    for (const auto& curve : curves) ends.insert(tests::points(curve).back().first);
    for (const auto& other : others) other_ends.insert(tests::points(other).back().first);
    EXPECT_EQ(other_ends, ends) << generations;
  }
}

TEST(SurvivalFigure, StepsDownWhereLifetimesEnd) {
  const Report report = make_report(small_study());
  const auto curves =
      with_class(parse_xml(survival_figure(report, report.survival[0], FigureSize::wide)), "curve");
  const auto steps = tests::points(curves.at(1));  // "b": 40, 80 and 120 s of 300 s
  ASSERT_EQ(steps.size(), 8u);
  const double left = steps[0].first, width = steps.back().first - left, top = steps[0].second;
  const double height = steps.back().second - top;
  EXPECT_NEAR(steps[1].first, left + width * 40.0 / 300.0, 0.1);
  EXPECT_NEAR(steps[2].second, top + height / 3.0, 0.1);
  EXPECT_NEAR(steps[5].first, left + width * 120.0 / 300.0, 0.1);
}

/// Columns and rows of the cells of each panel of a figure of 24 × 16 cells, from its border at 50 % and its
/// lowest line.
std::vector<std::set<std::pair<int, int>>> cells_of(const std::string& svg) {
  const auto elements = parse_xml(svg);
  const auto borders = with_class(elements, "whisker");
  std::vector<std::set<std::pair<int, int>>> panels(borders.size());
  for (const auto& element : elements) {
    if (element.name != "rect") continue;
    const double width = element.number("width"), height = element.number("height");
    for (std::size_t panel = 0; panel < borders.size(); ++panel) {
      const double column = (element.number("x") - borders[panel].number("x1")) / width + 10.0;
      const double bottom = std::max(borders[panel].number("y1"), borders[panel].number("y2"));
      const double row = (bottom - element.number("y")) / height - 1.0;
      if (column < -0.5 || column > 23.5) continue;
      EXPECT_NEAR(column, std::round(column), 0.05);
      EXPECT_NEAR(row, std::round(row), 0.05);
      panels[panel].emplace(std::lround(column), std::lround(row));
    }
  }
  return panels;
}

TEST(MutantsFigure, HasACellForEachScoreKeptAndChangeOfTheGait) {
  StudyData data = mutated_study();
  const auto mutate = [&](std::size_t record, const std::vector<record::Mutant>& mutants) {
    data.records[record].tests[0].mutants = mutants;
  };
  for (std::size_t i = 0; i < 6; ++i) mutate(i, {{.kept = 0.02, .change = 0.49}});
  mutate(0, {{.kept = 0.5, .change = 0.0}, {.kept = 0.499, .change = 0.1}});
  mutate(1, {{.kept = 1e300, .change = 1.0}, {.kept = 1.19, .change = 0.27}});
  mutate(2, {{.kept = 0.0, .change = 0.03}});
  const std::set<std::pair<int, int>> of_a{{10, 0}, {9, 1}, {23, 15}, {23, 4}, {0, 0}}, of_b{{0, 7}};
  for (const auto layout : {FigureSize::wide, FigureSize::narrow}) {
    const auto panels = cells_of(mutants_figure(make_report(data), "long", layout));
    ASSERT_EQ(panels.size(), 2u) << "a panel per condition";
    EXPECT_EQ(panels[0], of_a);
    EXPECT_EQ(panels[1], of_b);
  }
}

TEST(MutantsFigure, IsDarkerWhereThereAreMore) {
  StudyData data = mutated_study();
  for (ledger::Record& record : data.records) {
    record.tests[0].mutants.assign(9, {.kept = 0.9, .change = 0.02});
    record.tests[0].mutants.push_back({.kept = 0.1, .change = 0.4});
  }
  const auto elements = parse_xml(mutants_figure(make_report(data), "long", FigureSize::wide));
  EXPECT_EQ(with_class(elements, "shade8").size(), 2u) << "nine of ten";
  EXPECT_EQ(with_class(elements, "shade3").size(), 2u) << "one of ten: a ninth, a third by the root";
}

TEST(MutantsFigure, TellsTheShareOfViableMutantsOfEachCondition) {
  const std::string svg = mutants_figure(make_report(mutated_study()), "long", FigureSize::wide);
  EXPECT_NE(svg.find("67 % viable"), std::string::npos) << "a: from 0.65 on, four of six";
  EXPECT_NE(svg.find("50 % viable"), std::string::npos) << "b: from 0.6 on, three of six";
}

TEST(FigureFiles, AreSelfContained) {
  const auto files = figure_files(make_report(small_study()));
  std::vector<std::string> names;
  for (const FigureFile& file : files) {
    names.push_back(file.name);
    EXPECT_NO_THROW(parse_xml(file.svg)) << file.name;
    EXPECT_EQ(file.svg.find("var("), std::string::npos) << file.name;
    const bool bars = file.name.starts_with("distance");
    EXPECT_EQ(file.svg.find(".whisker {") != std::string::npos, bars) << file.name;
    EXPECT_NE(file.svg.find("svg .leg0 { color: #"), std::string::npos) << file.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"distance.svg", "distance-long.svg", "distance-ode.svg",
                                             "curves.svg", "upright-long.svg", "walking-long.svg",
                                             "upright-ode.svg", "walking-ode.svg"}));
  EXPECT_TRUE(figure_files(make_report({.study = sample_study({"a"}, 2), .records = {}, .unknown_files = {}}))
                  .empty());
}

}  // namespace
}  // namespace amble::report
