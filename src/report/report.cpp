#include "amble/report/report.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/io/json_file.hpp"
#include "amble/ledger/ledger.hpp"
#include "amble/report/tables.hpp"

namespace amble::report {

const std::string& Report::label(std::string_view condition) const {
  const auto* spec = data.study.find(condition);
  AMBLE_CHECK(spec != nullptr, "a condition of the study");
  return spec->label();
}

std::string Report::title() const {
  return data.study.title.empty() ? data.study.name : data.study.title;
}

int Report::index(std::string_view condition) const {
  const auto& conditions = data.study.conditions;
  return static_cast<int>(std::ranges::find(conditions, condition, &ledger::ConditionSpec::name) -
                          conditions.begin());
}

Report make_report(StudyData data) {
  Report report;
  report.data = std::move(data);
  report.digest = ledger::ledger_digest(report.data.study, report.data.records);
  report.remarks = remarks(report.data);
  report.objective = report.data.objective();
  report.judgements = judge(report.data);
  report.summaries = summarize(report.data);
  report.curves = best_curves(report.data);
  report.survival = survival_tables(report.data);
  report.stops = stop_counts(report.data);
  report.gaits = gait_tables(report.data);
  report.transfers = transfers(report.data);
  report.pairs = compare_pairs(report.data);
  report.typical = typical_tables(report.data);
  return report;
}

namespace {

io::Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return io::json_number(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  return nullptr;
}

io::Json rows_of(const Table& table) {
  io::Json rows = io::Json::array();
  for (const auto& row : table.rows) {
    io::Json object = io::Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) object[table.header[i]] = json_of(row[i]);
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace

std::string to_json(const Report& report) {
  io::Json verdicts = io::Json::object();
  const auto counts = count_verdicts(report.judgements);
  for (std::size_t i = 0; i < counts.size(); ++i) verdicts[std::string(verdict_names[i])] = counts[i];
  io::Json document{
      {"study", report.data.study.name},
      {"title", report.title()},
      {"digest", report.digest},
      {"runs_done", report.data.records.size()},
      {"runs_planned", report.data.planned()},
      {"remarks", report.remarks},
      {"judged_by",
       {{"verdict_rules", ledger::current_rules.verdicts}, {"stop_rule", ledger::current_rules.stop}}},
      {"verdicts", verdicts}};
  for (const Table& table : tables(report)) document[table.name] = rows_of(table);
  return io::sealed_json(report_format, report_version, document);
}

}  // namespace amble::report
