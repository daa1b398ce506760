#include "amble/report/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "amble/io/json_file.hpp"
#include "amble/report/report.hpp"
#include "amble/statistics/descriptive.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

const Table& find(const std::vector<Table>& all, const std::string& name) {
  return *std::ranges::find(all, name, &Table::name);
}

/// In which no two runs differ: no test of their distances has anything to tell.
StudyData uniform_study() {
  StudyData data = small_study();
  for (ledger::Record& record : data.records) record.best_objective = 5.0;
  return data;
}

TEST(Tables, AreRectangular) {
  for (const StudyData& data : {small_study(), large_study(12, 3), large_study(3, 1), uniform_study()})
    for (const Table& table : tables(make_report(data)))
      for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size()) << table.name;
}

TEST(Tables, LeaveCellsOfTestsEmptyThatHaveNothingToTell) {
  const auto all = tables(make_report(uniform_study()));
  const Table& pairs = find(all, "pairs");
  int of_distances = 0;
  for (const auto& row : pairs.rows) {
    ASSERT_EQ(row.size(), pairs.header.size());
    if (row[0] != Cell("train_m")) continue;
    ++of_distances;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& title = pairs.header[i];
      if (title.starts_with("student_") || title.starts_with("welch_")) {
        EXPECT_EQ(row[i], Cell()) << title;
      }
      if (title == "a12") {
        EXPECT_EQ(row[i], Cell(0.5));
      }
    }
  }
  EXPECT_EQ(of_distances, 1);
}

TEST(Tables, NameWhatAClaimComparesWith) {
  const auto all = tables(make_report(small_study()));
  const Table& claims = find(all, "claims");
  const auto title = std::ranges::find(claims.header, "against");
  ASSERT_NE(title, claims.header.end());
  const auto column = static_cast<std::size_t>(title - claims.header.begin());
  std::vector<Cell> against;
  for (const auto& row : claims.rows) against.push_back(row[column]);
  const Cell none = std::string();
  EXPECT_EQ(against, (std::vector<Cell>{std::string("b"), std::string("train_m"), none, none, none, none}));
}

TEST(Tables, OfAnEmptyLedgerHaveHeadersOnly) {
  StudyData data = small_study();
  data.records.clear();
  for (const Table& table : tables(make_report(data))) {
    EXPECT_FALSE(table.header.empty());
    EXPECT_EQ(table.rows.size(), table.name == "claims" ? 6u : 0u) << table.name;
  }
}

/// Columns of simple CSV text by their titles.
std::map<std::string, std::vector<std::string>> columns(const std::string& csv) {
  std::map<std::string, std::vector<std::string>> found;
  std::vector<std::string> header;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line + ",");
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (header.empty()) {
      header = row;
      continue;
    }
    for (std::size_t i = 0; i < header.size(); ++i) found[header[i]].push_back(i < row.size() ? row[i] : "");
  }
  return found;
}

TEST(Csv, OfRunsGivesTheSummaryAgainToTheBit) {
  const auto all = tables(make_report(large_study(3, 5)));
  const auto runs = columns(to_csv(find(all, "runs"))), summary = columns(to_csv(find(all, "summary")));
  ASSERT_EQ(summary.at("mean").size(), 3u * 13u);
  for (std::size_t row = 0; row < summary.at("mean").size(); ++row) {
    std::vector<double> values;
    for (std::size_t run = 0; run < runs.at("seed").size(); ++run)
      if (runs.at("condition")[run] == summary.at("condition")[row])
        values.push_back(std::stod(runs.at(summary.at("measure")[row])[run]));
    EXPECT_EQ(std::stod(summary.at("mean")[row]), statistics::mean(values));
    EXPECT_EQ(std::stod(summary.at("median")[row]), statistics::median(values));
    EXPECT_EQ(std::stod(summary.at("sd")[row]), statistics::moments(values)->sd);
  }
}

TEST(Csv, QuotesWhatNeedsIt) {
  const Table table{
      "t",
      "",
      {"a", "b", "c"},
      {{std::string("x, \"y\"\nz"), 0.1, Cell()}, {std::string("plain"), std::int64_t{-3}, 1e-30}}};
  EXPECT_EQ(to_csv(table), "a,b,c\n\"x, \"\"y\"\"\nz\",0.1,\nplain,-3,1e-30\n");
}

TEST(Json, HasTheTablesOfTheCsv) {
  const Report report = make_report(small_study());
  const auto document = io::unseal_json(report_format, report_version, to_json(report), "report").document;
  EXPECT_EQ(document["digest"], report.digest);
  EXPECT_EQ(document["runs_done"], 6);
  EXPECT_EQ(document["claims"].size(), 6u);
  for (const Table& table : tables(report)) {
    ASSERT_EQ(document[table.name].size(), table.rows.size()) << table.name;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      for (std::size_t i = 0; i < table.header.size(); ++i)
        if (const auto* number = std::get_if<double>(&table.rows[row][i])) {
          EXPECT_EQ(document[table.name][row][table.header[i]].get<double>(), *number);
        }
  }
}

}  // namespace
}  // namespace amble::report
