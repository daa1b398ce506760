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
                                                                   {"curves.svg", "9c7e368af984e1a6"},
                                                                   {"distance-long.svg", "e8b351bf6d9ea0e3"},
                                                                   {"distance-ode.svg", "413b2acbc8257273"},
                                                                   {"distance.svg", "2cbeec806fb0b438"},
                                                                   {"gaits.csv", "959e7d3d2a7f6266"},
                                                                   {"report.html", "33c05df33efc83bf"},
                                                                   {"runs.csv", "1f4f4065d23006c9"},
                                                                   {"survival.csv", "a9e3ab0405e89883"},
                                                                   {"upright-long.svg", "214850ba04c593db"},
                                                                   {"upright-ode.svg", "268ab588c02f97e7"},
                                                                   {"walking-long.svg", "39c744fbb7dd5186"},
                                                                   {"walking-ode.svg", "f597a1bd66f9e716"}});
}

TEST(GoldenReport, OfMutantsMatchesTheGoldenHash) {
  const Report report = make_report(mutated_study());
  auto made = everything_of(report);
  for (const Table& table : tables(report))
    if (table.name == "mutants") made["mutants.csv"] = to_csv(table);
  std::erase_if(made, [](const auto& file) {
    return file.first.find("mutants") == std::string::npos && file.first != "report.html";
  });
  tests::expect_golden(made, {{"mutants-long.svg", "6da6a6d73208b1a1"},
                              {"mutants.csv", "83f46b3dfd1e8088"},
                              {"report.html", "32258dae0791b430"}});
}

TEST(GoldenReport, OfFiveConditionsMatchesTheGoldenHash) {
  tests::expect_golden(everything_of(make_report(large_study(5, 9))),
                       {{"bests.csv", "65b355680fcc9d62"},
                        {"curves.csv", "e722cbcdc2c0b6de"},
                        {"curves.svg", "319b861f836ab715"},
                        {"distance-long.svg", "9f39cfb2d7ee4b04"},
                        {"distance-ode.svg", "c4a736df7b5d40a1"},
                        {"distance.svg", "a4fba0732c0439a0"},
                        {"gaits.csv", "624a2e0c41e13fe1"},
                        {"report.html", "014b9fdcdcff0994"},
                        {"runs.csv", "e9026294e9c5c3d6"},
                        {"survival.csv", "e924fdae1fbaf0c6"},
                        {"upright-long.svg", "d5e3a6926e39ed02"},
                        {"upright-ode.svg", "8ab356e9f0255d09"},
                        {"walking-long.svg", "d71877eed99c3d12"},
                        {"walking-ode.svg", "66a09338ea0c272b"}});
}

TEST(GoldenReport, OfAStudyHalfDoneMatchesTheGoldenHash) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1, data.records.begin() + 4);
  data.study.claims[0].alpha = 0.01;
  data.unknown_files = {"notes.txt"};
  tests::expect_golden({{"half.html", make_page(make_report(std::move(data)))}},
                       {{"half.html", "b064bed3d6c42be0"}});
}

}  // namespace
}  // namespace amble::report
