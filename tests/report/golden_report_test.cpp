#include <gtest/gtest.h>

#include "amble/report/figures.hpp"
#include "amble/report/page.hpp"
#include "amble/report/tables.hpp"
#include "tests/figures/golden.hpp"
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
                                                                   {"curves.svg", "6c520d01e74c57bd"},
                                                                   {"distance-long.svg", "7e400d8078fdbdf8"},
                                                                   {"distance-ode.svg", "d2efe48e54d7170e"},
                                                                   {"distance.svg", "9c6b93ca425adec2"},
                                                                   {"gaits.csv", "959e7d3d2a7f6266"},
                                                                   {"report.html", "05209efbcd21993e"},
                                                                   {"runs.csv", "1f4f4065d23006c9"},
                                                                   {"survival.csv", "a9e3ab0405e89883"},
                                                                   {"upright-long.svg", "db68d5dd2e14c067"},
                                                                   {"upright-ode.svg", "15fcd9103a15cc7f"},
                                                                   {"walking-long.svg", "6f747892234f463c"},
                                                                   {"walking-ode.svg", "9768c91b3fe7ac02"}});
}

TEST(GoldenReport, OfMutantsMatchesTheGoldenHash) {
  const Report report = make_report(mutated_study());
  auto made = everything_of(report);
  for (const Table& table : tables(report))
    if (table.name == "mutants") made["mutants.csv"] = to_csv(table);
  std::erase_if(made, [](const auto& file) {
    return file.first.find("mutants") == std::string::npos && file.first != "report.html";
  });
  tests::expect_golden(made, {{"mutants-long.svg", "54f814c86cb1bf2d"},
                              {"mutants.csv", "83f46b3dfd1e8088"},
                              {"report.html", "148d2dc3bab29365"}});
}

TEST(GoldenReport, OfFiveConditionsMatchesTheGoldenHash) {
  tests::expect_golden(everything_of(make_report(large_study(5, 9))),
                       {{"bests.csv", "65b355680fcc9d62"},
                        {"curves.csv", "e722cbcdc2c0b6de"},
                        {"curves.svg", "b7b5f5e06e3b2e01"},
                        {"distance-long.svg", "8486e9373b1b7429"},
                        {"distance-ode.svg", "9b57fef4b5bb87dc"},
                        {"distance.svg", "b50e8c08468766b9"},
                        {"gaits.csv", "624a2e0c41e13fe1"},
                        {"report.html", "665f10033ed2ee7e"},
                        {"runs.csv", "e9026294e9c5c3d6"},
                        {"survival.csv", "e924fdae1fbaf0c6"},
                        {"upright-long.svg", "eaf7c66f041e51ac"},
                        {"upright-ode.svg", "058efbf282c06714"},
                        {"walking-long.svg", "6cda526e92bd1395"},
                        {"walking-ode.svg", "e6b3281177ff7ee4"}});
}

TEST(GoldenReport, OfAStudyHalfDoneMatchesTheGoldenHash) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1, data.records.begin() + 4);
  data.study.claims[0].alpha = 0.01;
  data.unknown_files = {"notes.txt"};
  tests::expect_golden({{"half.html", make_page(make_report(std::move(data)))}},
                       {{"half.html", "0b98d16da7223dcb"}});
}

}  // namespace
}  // namespace amble::report
