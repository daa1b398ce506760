#include <gtest/gtest.h>

#include "amble/report/csv.hpp"
#include "amble/report/figures.hpp"
#include "amble/report/page.hpp"
#include "amble/report/tables.hpp"
#include "tests/graphics/golden.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

/// Page, figures, and the tables whose numbers need no function of the C library, which may differ between
/// processors in the last bit.
std::map<std::string, std::string> everything_of(const Report& report) {
  std::map<std::string, std::string> made{{"report.html", make_page(report)}};
  for (const Table& table : tables(report))
    for (const char* exact : {"runs", "bests", "curves", "survival", "gaits"})
      if (table.name == exact) made[table.name + ".csv"] = to_csv(table);
  for (const FigureFile& figure : figure_files(report)) made[figure.name] = figure.svg;
  return made;
}

TEST(GoldenReport, OfAStudyWithClaimsOfAllKindsMatchesTheGoldenHash) {
  tests::expect_golden(everything_of(make_report(small_study())), {{"bests.csv", "1c77f25a4bd6a929"},
                                                                   {"curves.csv", "d40556d895ef1a3b"},
                                                                   {"curves.svg", "671d4cda456436f0"},
                                                                   {"distance-long.svg", "e63c0d3c979bbb3c"},
                                                                   {"distance-ode.svg", "6052cd62dbc62d2b"},
                                                                   {"distance.svg", "b884d446a275f298"},
                                                                   {"gaits.csv", "959e7d3d2a7f6266"},
                                                                   {"report.html", "37582ef9c33b135e"},
                                                                   {"runs.csv", "dc398070b99324c7"},
                                                                   {"survival.csv", "a9e3ab0405e89883"},
                                                                   {"upright-long.svg", "bea62a992745a80f"},
                                                                   {"upright-ode.svg", "ee5cf03f60e62bca"},
                                                                   {"walking-long.svg", "75797cadbdbaf7bf"},
                                                                   {"walking-ode.svg", "e18b8241fb6636c1"}});
}

TEST(GoldenReport, OfFiveConditionsMatchesTheGoldenHash) {
  tests::expect_golden(everything_of(make_report(large_study(5, 9))),
                       {{"bests.csv", "65b355680fcc9d62"},
                        {"curves.csv", "e722cbcdc2c0b6de"},
                        {"curves.svg", "2b6b16ac1eafeaa7"},
                        {"distance-long.svg", "172009886b9ff6a5"},
                        {"distance-ode.svg", "204d79a82b26d9f9"},
                        {"distance.svg", "aee8d37439e73fbb"},
                        {"gaits.csv", "624a2e0c41e13fe1"},
                        {"report.html", "e75d3eede8ecfc26"},
                        {"runs.csv", "390479e93ef5d2ce"},
                        {"survival.csv", "e924fdae1fbaf0c6"},
                        {"upright-long.svg", "25e3279bdff332a8"},
                        {"upright-ode.svg", "3d51ccc4489910bf"},
                        {"walking-long.svg", "50f11938c1edc5e9"},
                        {"walking-ode.svg", "50c4c1184a8f7a56"}});
}

TEST(GoldenReport, OfAStudyHalfDoneMatchesTheGoldenHash) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1, data.records.begin() + 4);
  data.study.claims[0].alpha = 0.01;
  data.unknown_files = {"notes.txt"};
  tests::expect_golden({{"half.html", make_page(make_report(std::move(data)))}},
                       {{"half.html", "f63ce3c93018212c"}});
}

}  // namespace
}  // namespace amble::report
