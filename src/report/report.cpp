#include "amble/report/report.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/ledger/ledger.hpp"

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

}  // namespace amble::report
