#include "amble/figures/fitness_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/figures/xml.hpp"

namespace amble::figures {
namespace {

using testing::Contains;

record::Generations table() {
  record::Generations generations;
  generations.generation = {0, 1, 2};
  generations.best = {0.5, 1.5, 3.04};
  generations.mean = {0.25, 0.5, 1.0};
  generations.median = {0.1, 0.2, 0.9};
  generations.species = {1, 20, 29};
  generations.mean_hidden = {0, 0.5, 1.25};
  generations.mean_links = {8, 8.5, 9.75};
  return generations;
}

class FitnessFigure : public testing::TestWithParam<FigureSize> {};

TEST_P(FitnessFigure, LabelsEveryCurveWithItsLastValue) {
  const auto texts = tests::texts(tests::parse_xml(fitness_figure(table(), GetParam())));
  for (const char* label : {"best 3.04 m", "mean 1.00 m", "median 0.90 m", "29", "1.2", "9.8", "generation"})
    EXPECT_THAT(texts, Contains(label));
}

TEST_P(FitnessFigure, NamesAnObjectiveThatIsNoDistanceAndGivesItNoUnit) {
  const std::string figure = fitness_figure(table(), GetParam(), {.unit = "", .title = "Score"});
  EXPECT_THAT(tests::texts(tests::parse_xml(figure)), Contains("best 3.04"));
  EXPECT_THAT(figure, testing::HasSubstr("Score over 3 generations: best 3.04, mean 1.00, median 0.90 in"));
  EXPECT_THAT(figure, testing::Not(testing::HasSubstr(" m<")));
}

TEST_P(FitnessFigure, DrawsCurvesInProportion) {
  const auto elements = tests::parse_xml(fitness_figure(table(), GetParam()));
  EXPECT_EQ(tests::with_class(elements, "curve").size(), 6u);
  const auto best = tests::points(tests::with_class(elements, "best").at(0));
  const auto mean = tests::points(tests::with_class(elements, "mean").at(0));
  ASSERT_EQ(best.size(), 3u);
  EXPECT_NEAR(best[1].first - best[0].first, best[2].first - best[1].first, 0.11);
  // best rises by 2.54 m where mean rises by 0.75 m; up is towards zero. Coordinates are rounded to 0.1 px.
  EXPECT_NEAR((best[0].second - best[2].second) / (mean[0].second - mean[2].second), 2.54 / 0.75, 0.02);
}

TEST_P(FitnessFigure, DrawsWhatTheChampionTypicallyDoesWithTheBandOfItsQuartiles) {
  record::Generations generations = table();
  EXPECT_TRUE(
      tests::with_class(tests::parse_xml(fitness_figure(generations, GetParam())), "typical").empty());
  generations.typical = {0.4, 1.0, 2.0};
  generations.typical_lower = {0.3, 0.8, 1.5};
  generations.typical_upper = {0.5, 1.2, 2.5};
  const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
  EXPECT_THAT(tests::texts(elements), Contains("typical 2.00 m"));
  const auto typical = tests::points(tests::with_class(elements, "typical").at(0));
  const auto band = tests::points(tests::with_class(elements, "quartiles").at(0));
  ASSERT_EQ(band.size(), 6u);
  EXPECT_LT(band[2].second, typical[2].second) << "the upper quartile is above";
  EXPECT_GT(band[3].second, typical[2].second) << "the lower one below";
}

TEST_P(FitnessFigure, DrawsAMapOverItsEvaluations) {
  record::Generations generations = table();
  generations.coverage = {0.1, 0.2, 0.25};
  const auto drawn = [&](double first, double each) {
    generations.evaluations = {first, each, each};
    return tests::parse_xml(fitness_figure(generations, GetParam()));
  };
  const auto elements = drawn(4e6, 1e6);
  const auto texts = tests::texts(elements);
  EXPECT_THAT(texts, Contains("million evaluations"));
  EXPECT_THAT(texts, Contains("5")) << "a tick of the axis from 4 to 6 million";
  EXPECT_THAT(texts, testing::Not(Contains("generation")));
  const auto best = tests::points(tests::with_class(elements, "best").at(0));
  EXPECT_NEAR(best[1].first - best[0].first, best[2].first - best[1].first, 0.11) << "the first counts whole";
  EXPECT_THAT(tests::texts(drawn(1000.0, 500.0)), Contains("thousand evaluations"));
  EXPECT_THAT(tests::texts(drawn(999.0, 500.0)), Contains("evaluations"));
  EXPECT_THAT(tests::texts(drawn(1e6, 499'999.0)), Contains("thousand evaluations"));
}

TEST_P(FitnessFigure, IsNoLongerThanWideWhateverTheGenerationsAndKeepsEachExtreme) {
  record::Generations generations;
  for (int n = 0; n < 20'000; ++n) {
    generations.generation.push_back(n);
    generations.best.push_back(n == 7777 ? 50.0 : n == 7778 ? -50.0 : 0.001 * (n % 7));
    generations.mean.push_back(0.0);
    generations.median.push_back(0.0);
  }
  const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
  const auto best = tests::points(tests::with_class(elements, "best").at(0));
  EXPECT_LE(best.size(), 4.0 * width_px(GetParam()));
  const auto [highest, lowest] =
      std::ranges::minmax(best, {}, [](const auto& point) { return point.second; });
  EXPECT_NEAR(highest.first, lowest.first, 0.11);
  const double base = tests::with_class(elements, "axis").at(0).number("y1");
  EXPECT_NEAR(lowest.second, base, 0.06) << "the lowest value is the axis";
  EXPECT_TRUE(std::ranges::is_sorted(best, {}, [](const auto& point) { return point.first; }));
}

TEST_P(FitnessFigure, FillsWhatLiesBelowTheBestDownToTheAxis) {
  const auto elements = tests::parse_xml(fitness_figure(table(), GetParam()));
  const auto best = tests::points(tests::with_class(elements, "best").at(0));
  const double base = tests::with_class(elements, "axis").at(0).number("y1");
  auto area = tests::points(tests::with_class(elements, "under-best").at(0));
  ASSERT_EQ(area.size(), best.size() + 2);
  EXPECT_EQ(area.back().first, best.front().first);
  EXPECT_EQ(area[best.size()].first, best.back().first);
  for (std::size_t i = best.size(); i < area.size(); ++i) EXPECT_NEAR(area[i].second, base, 0.06);
  area.resize(best.size());
  EXPECT_EQ(area, best);
}

TEST_P(FitnessFigure, PutsEachLabelBesideTheEndOfItsCurve) {
  record::Generations generations = table();
  // The ends are in another order than the beginnings, and far enough apart for labels at their own places.
  generations.best = {1.0, 2.0, 9.0};
  generations.mean = {8.0, 3.0, 1.0};
  generations.median = {0.0, 4.0, 5.0};
  const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
  for (const char* curve : {"best", "mean", "median"}) {
    const auto drawn = tests::with_class(elements, curve);
    const auto end = tests::points(drawn.at(0)).back();
    const auto label = std::ranges::find(drawn, "text", &tests::XmlElement::name);
    ASSERT_NE(label, drawn.end());
    EXPECT_NEAR(label->number("y"), end.second + 4.0, 0.2) << curve;
    EXPECT_GT(label->number("x"), end.first) << curve;
  }
}

TEST_P(FitnessFigure, TakesASingleGenerationAndNoProgressAtAll) {
  record::Generations generations;
  for (auto* column : {&generations.generation, &generations.best, &generations.mean, &generations.median,
                       &generations.species, &generations.mean_hidden, &generations.mean_links})
    column->push_back(0.0);
  EXPECT_THAT(tests::texts(tests::parse_xml(fitness_figure(generations, GetParam()))),
              Contains("best 0.00 m"));
}

TEST_P(FitnessFigure, LeavesOutColumnsThatTheSearchDoesNotHave) {
  record::Generations generations = table();
  generations.species.clear();
  generations.mean_links.clear();
  const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
  EXPECT_EQ(tests::with_class(elements, "small").size(), 2u) << "curve and dot of the hidden nodes";
  EXPECT_THAT(tests::texts(elements), Contains("1.2"));
}

TEST_P(FitnessFigure, LeavesNoGapWhereAColumnIsMissing) {
  const auto left_of_first_panel = [](const record::Generations& generations) {
    const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
    return tests::points(tests::with_class(elements, "small").at(0)).at(0).first;
  };
  record::Generations generations = table();
  const double left = left_of_first_panel(generations);
  generations.species.clear();
  EXPECT_EQ(left_of_first_panel(generations), left);
  generations.mean_hidden.clear();
  EXPECT_EQ(left_of_first_panel(generations), left);
}

TEST_P(FitnessFigure, ShowsNegativeValues) {
  record::Generations generations = table();
  generations.median = {-1.0, -0.5, -0.25};
  const auto elements = tests::parse_xml(fitness_figure(generations, GetParam()));
  EXPECT_THAT(tests::texts(elements), Contains("median \u22120.25 m"));
  // The first axis is that of the distances; nothing lies below it.
  const double base = tests::with_class(elements, "axis").at(0).number("y1");
  for (const auto& [x, y] : tests::points(tests::with_class(elements, "median").at(0))) EXPECT_LE(y, base);
}

INSTANTIATE_TEST_SUITE_P(Layouts, FitnessFigure, testing::Values(FigureSize::wide, FigureSize::narrow));

}  // namespace
}  // namespace amble::figures
