#include "amble/report/figures.hpp"

#include <fmt/format.h>

#include "amble/core/index.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/report/curves_figure.hpp"
#include "amble/report/mutants_figure.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page.hpp"
#include "amble/report/survival_figure.hpp"
#include "amble/report/typical_figure.hpp"

namespace amble::report {
namespace {

Strip make_strip(const Report& report, const SampleSummary& sample, std::string name, std::string css_class) {
  return {.name = std::move(name),
          .css_class = std::move(css_class),
          .values = report.data.values(sample.condition, sample.measure),
          .mean = sample.summary.mean,
          .interval = sample.summary.mean_interval,
          .text = estimate_text(sample.summary.mean, sample.summary.mean_interval,
                                report.data.unit_of(sample.measure, sample.condition))};
}

}  // namespace

std::vector<StripRow> training_rows(const Report& report) {
  std::vector<StripRow> rows;
  for (const ledger::ConditionSpec& condition : report.data.study.conditions)
    if (const auto* sample = find_summary(report.summaries, "train_m", condition.name))
      rows.push_back(
          {condition.label(),
           {make_strip(report, *sample, "evolution", figures::leg_class(report.index(condition.name)))}});
  return rows;
}

std::vector<StripRow> test_rows(const Report& report, const std::string& test) {
  std::vector<StripRow> rows;
  for (const ledger::ConditionSpec& condition : report.data.study.conditions) {
    const auto* tested = find_summary(report.summaries, test + ".distance_m", condition.name);
    const auto* trained = find_summary(report.summaries, "train_m", condition.name);
    if (tested == nullptr || trained == nullptr) continue;
    StripRow row{condition.label(), {}};
    if (report.data.objective(condition.name).is_distance)
      row.strips.push_back(make_strip(report, *trained, "evolution", "base"));
    row.strips.push_back(
        make_strip(report, *tested, "test", figures::leg_class(report.index(condition.name))));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<FigureFile> figure_files(const Report& report) {
  using figures::FigureSize;
  std::vector<FigureFile> files;
  const auto add = [&files](const std::string& name, std::string element) {
    files.push_back({name + ".svg", standalone_figure(std::move(element))});
  };
  if (report.data.records.empty()) return files;
  add("distance", rows_figure(training_rows(report), report.objective.unit,
                              fmt::format("{} in evolution", report.objective_title()), FigureSize::wide));
  for (const ledger::TestSpec& test : report.data.study.tests)
    if (const auto rows = test_rows(report, test.name); !rows.empty())
      add("distance-" + test.name,
          rows_figure(rows, " m", "Distance in test " + test.name, FigureSize::wide));
  for (const TypicalTable& typical : report.typical)
    if (typical.columns.size() > 1) add(typical.name(), typical_figure(report, typical, FigureSize::wide));
  add("curves", curves_figure(report, FigureSize::wide));
  for (const ledger::TestSpec& test : report.data.study.tests)
    if (has_mutants(report, test.name))
      add("mutants-" + test.name, mutants_figure(report, test.name, FigureSize::wide));
  for (const SurvivalTable& table : report.survival)
    add(fmt::format("{}-{}", activity_names[to_index(table.activity)], table.test),
        survival_figure(report, table, FigureSize::wide));
  return files;
}

}  // namespace amble::report
