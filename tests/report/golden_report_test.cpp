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
                                                                   {"curves.svg", "e29fb40331f2521c"},
                                                                   {"distance-long.svg", "3e7476a288a24dec"},
                                                                   {"distance-ode.svg", "1bb5722a8fa841a0"},
                                                                   {"distance.svg", "a1ae8b38baa8ff83"},
                                                                   {"gaits.csv", "959e7d3d2a7f6266"},
                                                                   {"report.html", "b7c40c9fcb6b7821"},
                                                                   {"runs.csv", "1f4f4065d23006c9"},
                                                                   {"survival.csv", "a9e3ab0405e89883"},
                                                                   {"upright-long.svg", "684b338da7503a01"},
                                                                   {"upright-ode.svg", "8a2373e38df39238"},
                                                                   {"walking-long.svg", "649388c83894e8e3"},
                                                                   {"walking-ode.svg", "fd2f2a57fe182348"}});
}

TEST(GoldenReport, OfMutantsMatchesTheGoldenHash) {
  const Report report = make_report(mutated_study());
  auto made = everything_of(report);
  for (const Table& table : tables(report))
    if (table.name == "mutants") made["mutants.csv"] = to_csv(table);
  std::erase_if(made, [](const auto& file) {
    return file.first.find("mutants") == std::string::npos && file.first != "report.html";
  });
  tests::expect_golden(made, {{"mutants-long.svg", "ebb4624d9e0add85"},
                              {"mutants.csv", "83f46b3dfd1e8088"},
                              {"report.html", "4a1663821334d05f"}});
}

TEST(GoldenReport, OfFiveConditionsMatchesTheGoldenHash) {
  tests::expect_golden(everything_of(make_report(large_study(5, 9))),
                       {{"bests.csv", "65b355680fcc9d62"},
                        {"curves.csv", "e722cbcdc2c0b6de"},
                        {"curves.svg", "ed24ba3fbbad9670"},
                        {"distance-long.svg", "6561ef7b2c7e5816"},
                        {"distance-ode.svg", "4503123cb8ee6ffa"},
                        {"distance.svg", "49e1cb5cbb00ada0"},
                        {"gaits.csv", "624a2e0c41e13fe1"},
                        {"report.html", "d1b6e1266da32983"},
                        {"runs.csv", "e9026294e9c5c3d6"},
                        {"survival.csv", "e924fdae1fbaf0c6"},
                        {"upright-long.svg", "4f9400e05eeb3e93"},
                        {"upright-ode.svg", "cd29f0a56293b633"},
                        {"walking-long.svg", "386740f9907fdc03"},
                        {"walking-ode.svg", "cd85295829630920"}});
}

TEST(GoldenReport, OfAStudyHalfDoneMatchesTheGoldenHash) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1, data.records.begin() + 4);
  data.study.claims[0].alpha = 0.01;
  data.unknown_files = {"notes.txt"};
  tests::expect_golden({{"half.html", make_page(make_report(std::move(data)))}},
                       {{"half.html", "ad4f8595654bc39e"}});
}

}  // namespace
}  // namespace amble::report
