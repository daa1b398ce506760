#include "amble/report/typical.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/record/levels.hpp"
#include "amble/report/study_data.hpp"

namespace amble::report {
namespace {

/// Whether two tests differ in nothing but noise, level and episodes.
bool is_alike(const ledger::TestSpec& a, const ledger::TestSpec& b) {
  return a.engine == b.engine && a.engine_own == b.engine_own && a.seconds == b.seconds &&
         a.ground == b.ground && a.damage == b.damage && a.command == b.command;
}

/// Whether it is a trial as evolution has it, but for engine, length and noise.
bool is_plain(const ledger::TestSpec& test) {
  return test.engine_own.empty() && test.ground.empty() && test.damage.empty() && test.command.empty();
}

/// Whether the run's distance in evolution is that of an undisturbed trial of that length.
bool walked_undisturbed(const ledger::Record& run, double seconds) {
  return ledger::evolved_undisturbed(run) && ledger::evolution_trial_s(run) == seconds &&
         ledger::objective_of(run).is_distance;
}

/// The measures of the undisturbed trial beside a test at a level.
std::vector<std::string> undisturbed_measures(const StudyData& data, const ledger::TestSpec& levelled) {
  std::vector<std::string> measures;
  for (const ledger::TestSpec& test : data.study.tests)
    if (!test.is_disturbed() && is_alike(test, levelled)) measures.push_back(test.name + ".distance_m");
  if (!measures.empty()) return measures;
  const bool at_home = levelled.engine.empty() && is_plain(levelled);
  const bool undisturbed = std::ranges::all_of(data.records, [&](const ledger::Record& run) {
    return !levelled.applies_to(run.condition) || walked_undisturbed(run, levelled.seconds);
  });
  if (at_home && undisturbed) measures.push_back("train_m");
  return measures;
}

/// How strong a level is: its place among all.
std::size_t strength(const TypicalTable::Column& column) {
  const auto levels = record::levels();
  return to_index(std::ranges::find(levels, column.level, &record::Level::name) - levels.begin());
}

std::optional<TypicalPoint> make_point(const StudyData& data, const std::string& condition,
                                       const TypicalTable& table, std::size_t column) {
  // Conditions may have a test of their own at the same level.
  const auto& measures = table.columns[column].measures;
  const auto found = std::ranges::find_if(
      measures, [&](const std::string& each) { return !data.values(condition, each).empty(); });
  if (found == measures.end()) return std::nullopt;
  const std::string& measure = *found;
  TypicalPoint point{.column = column,
                     .measure = measure,
                     .distances_m = data.values(condition, measure),
                     .summary = {},
                     .median = {},
                     .fell_share = {}};
  const auto summary = statistics::summarize(point.distances_m, confidence);
  if (!summary) return std::nullopt;
  point.summary = *summary;
  if (point.distances_m.size() >= fewest_resampled)
    point.median = statistics::bootstrap(point.distances_m, statistics::median);
  const std::string test = measure.substr(0, measure.find('.'));
  double fell = 0.0, trials = 0.0;
  for (const ledger::Record* run : data.runs(condition))
    if (const auto* result = data.result(*run, test)) {
      const auto count = static_cast<double>(result->episodes.size());
      fell += result->typical().fell_share * count;
      trials += count;
    }
  if (trials > 0.0) point.fell_share = fell / trials;
  return point;
}

TypicalTable make_table(const StudyData& data, const ledger::TestSpec& first) {
  TypicalTable table{.engine = first.engine,
                     .trial_s = first.seconds,
                     .as_in = is_plain(first) ? "" : first.name,
                     .columns = {},
                     .curves = {}};
  if (auto measures = undisturbed_measures(data, first); !measures.empty())
    table.columns.push_back({.level = "", .measures = std::move(measures)});
  const auto undisturbed = static_cast<std::ptrdiff_t>(table.columns.size());
  for (const ledger::TestSpec& test : data.study.tests) {
    if (test.level.empty() || !is_alike(test, first)) continue;
    auto column = std::ranges::find(table.columns, test.level, &TypicalTable::Column::level);
    if (column == table.columns.end())
      column = table.columns.insert(column, {.level = test.level, .measures = {}});
    column->measures.push_back(test.name + ".distance_m");
  }
  std::ranges::stable_sort(table.columns.begin() + undisturbed, table.columns.end(), {}, strength);
  for (const ledger::ConditionSpec& condition : data.study.conditions) {
    TypicalCurve curve{.condition = condition.name, .points = {}};
    bool at_a_level = false;
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      if (auto point = make_point(data, condition.name, table, column)) {
        at_a_level = at_a_level || !table.columns[column].level.empty();
        curve.points.push_back(std::move(*point));
      }
    if (at_a_level) table.curves.push_back(std::move(curve));
  }
  return table;
}

}  // namespace

const TypicalPoint* TypicalCurve::at(std::size_t column) const {
  const auto found = std::ranges::find(points, column, &TypicalPoint::column);
  return found == points.end() ? nullptr : &*found;
}

std::string TypicalTable::name() const {
  return fmt::format("typical-{}s{}{}{}{}", trial_s, engine.empty() ? "" : "-", engine,
                     as_in.empty() ? "" : "-", as_in);
}

std::string_view disturbance_name(const TypicalTable::Column& column) {
  return column.level.empty() ? std::string_view("none") : std::string_view(column.level);
}

std::vector<TypicalTable> typical_tables(const StudyData& data) {
  std::vector<TypicalTable> tables;
  std::vector<const ledger::TestSpec*> firsts;
  for (const ledger::TestSpec& test : data.study.tests) {
    const auto known = [&](const ledger::TestSpec* other) { return is_alike(*other, test); };
    if (test.level.empty() || std::ranges::any_of(firsts, known)) continue;
    firsts.push_back(&test);
    if (TypicalTable table = make_table(data, test); !table.curves.empty())
      tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace amble::report
