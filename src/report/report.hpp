#pragma once

#include <string>
#include <vector>

#include "amble/report/comparisons.hpp"
#include "amble/report/curves.hpp"
#include "amble/report/gait_counts.hpp"
#include "amble/report/lifetimes.hpp"
#include "amble/report/stop_rules.hpp"
#include "amble/report/study_data.hpp"
#include "amble/report/transfer.hpp"
#include "amble/report/typical.hpp"
#include "amble/report/verdict.hpp"

namespace amble::report {

/// All numbers of a report, computed once: page, tables and figures only show them. The same ledger gives the
/// same bits.
struct Report {
  StudyData data;
  std::string digest;                ///< of the ledger (ledger::ledger_digest)
  std::vector<std::string> remarks;  ///< remarks() of the data
  record::Objective objective;       ///< StudyData::objective()
  std::vector<Judgement> judgements;
  std::vector<SampleSummary> summaries;
  std::vector<BestCurve> curves;
  std::vector<SurvivalTable> survival;
  std::vector<StopCounts> stops;
  std::vector<GaitTable> gaits;
  std::vector<Transfer> transfers;
  std::vector<PairTable> pairs;
  std::vector<TypicalTable> typical;

  const std::string& label(std::string_view condition) const;
  /// "Distance" or "Score": Objective::name() as titles have it.
  std::string_view objective_title() const { return objective.is_distance ? "Distance" : "Score"; }
  std::string title() const;
  /// Index of a condition in the study, which decides its colour.
  int index(std::string_view condition) const;
};

Report make_report(StudyData data);

inline constexpr std::string_view report_format = "amble-report";
inline constexpr int report_version = 1;

/// The numbers of a report as one sealed document (io/json_file.hpp): name, title, digest, remarks, count of
/// verdicts, and the tables of tables.hpp as lists of objects; what a row lacks is null.
std::string to_json(const Report& report);

}  // namespace amble::report
