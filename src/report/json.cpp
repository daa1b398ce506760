#include "amble/report/json.hpp"

#include "amble/io/json_file.hpp"
#include "amble/report/tables.hpp"

namespace amble::report {
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
