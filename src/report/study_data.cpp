#include "amble/report/study_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/ledger/ledger.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/report/number_text.hpp"

namespace amble::report {
namespace {

/// "supg: 3 of 20; sine: 2 of 20", of conditions that lack some.
std::string missing_runs(const StudyData& data) {
  std::string text;
  for (const ledger::ConditionSpec& condition : data.study.conditions) {
    const std::size_t done = data.runs(condition.name).size(), planned = data.planned(condition.name);
    if (done < planned)
      text += fmt::format("{}{}: {} of {}", text.empty() ? "" : "; ", condition.label(), done, planned);
  }
  return text;
}

/// How many finished runs lack a test that the study has for them.
std::size_t without_test(const StudyData& data, const ledger::TestSpec& test) {
  return to_index(std::ranges::count_if(data.records, [&](const ledger::Record& record) {
    return test.applies_to(record.condition) && data.result(record, test.name) == nullptr;
  }));
}

/// Whether the values of a function are not all the same.
template <typename Function>
bool differs(const std::vector<const ledger::Record*>& runs, Function&& value) {
  return std::ranges::any_of(runs, [&](const auto* run) { return value(*run) != value(*runs.front()); });
}

void remark_on_condition(const StudyData& data, const ledger::ConditionSpec& condition,
                         std::vector<std::string>& remarks) {
  const auto runs = data.runs(condition.name);
  if (runs.empty()) return;
  const auto remark = [&](std::string_view what) {
    remarks.push_back(fmt::format("{}: runs differ in their {}; they are no sample of one condition.",
                                  condition.label(), what));
  };
  if (differs(runs, [](const ledger::Record& run) { return run.config; })) remark("settings");
  if (differs(runs, [](const ledger::Record& run) { return run.engine; })) remark("engine");
  if (differs(runs, [](const ledger::Record& run) { return run.generations; }))
    remark("number of generations");
  const int expected = condition.generations > 0 ? condition.generations : data.study.generations;
  if (expected > 0 && runs.front()->generations != expected)
    remarks.push_back(fmt::format("{}: the runs have {} generations, the study asks for {}.",
                                  condition.label(), runs.front()->generations, expected));
}

/// Conditions whose runs were not all tested by the same settings, which their hashes tell.
void remark_on_settings(const StudyData& data, const ledger::TestSpec& test,
                        std::vector<std::string>& remarks) {
  for (const ledger::ConditionSpec& condition : data.study.conditions) {
    std::set<std::string> settings;
    for (const ledger::Record* run : data.runs(condition.name))
      if (const auto* result = data.result(*run, test.name)) settings.insert(result->settings);
    if (settings.size() > 1)
      remarks.push_back(
          fmt::format("Test {}: runs of {} were tested with different settings; they are no "
                      "sample of one test.",
                      test.name, condition.label()));
  }
}

void remark_on_test(const StudyData& data, const ledger::TestSpec& test, std::vector<std::string>& remarks) {
  if (const std::size_t lacking = without_test(data, test); lacking > 0)
    remarks.push_back(fmt::format("Test {}: {} finished {} not have it yet.", test.name, lacking,
                                  lacking == 1 ? "run does" : "runs do"));
  for (const ledger::Record& record : data.records)
    if (const auto* result = data.result(record, test.name); result && result->trial_s != test.seconds) {
      remarks.push_back(fmt::format("Test {}: there are trials of {} s, the study asks for {} s.", test.name,
                                    result->trial_s, test.seconds));
      break;
    }
  remark_on_settings(data, test, remarks);
}

}  // namespace

std::size_t StudyData::planned() const {
  std::size_t all = 0;
  for (const ledger::ConditionSpec& condition : study.conditions) all += study.seeds_of(condition).size();
  return all;
}

std::size_t StudyData::planned(std::string_view condition) const {
  const auto* spec = study.find(condition);
  AMBLE_CHECK(spec != nullptr, "a condition of the study");
  return study.seeds_of(*spec).size();
}

std::vector<const ledger::Record*> StudyData::runs(std::string_view condition) const {
  std::vector<const ledger::Record*> runs;
  for (const ledger::Record& record : records)
    if (record.condition == condition) runs.push_back(&record);
  return runs;
}

const ledger::TestResult* StudyData::result(const ledger::Record& run, std::string_view test) const {
  const ledger::TestSpec* const spec = study.find_test(test);
  return spec != nullptr && spec->applies_to(run.condition) ? run.find_test(test) : nullptr;
}

std::optional<double> StudyData::value(const ledger::Record& run, std::string_view measure) const {
  const std::size_t dot = measure.find('.');
  if (dot != std::string_view::npos && result(run, measure.substr(0, dot)) == nullptr) return std::nullopt;
  return ledger::measure(run, measure);
}

std::vector<double> StudyData::values(std::string_view condition, std::string_view measure) const {
  std::vector<double> values;
  for (const ledger::Record* run : runs(condition))
    if (const auto one = value(*run, measure)) values.push_back(*one);
  return values;
}

record::Objective StudyData::objective(std::string_view condition) const {
  record::Objective all;
  for (const ledger::Record& record : records) {
    if (!condition.empty() && record.condition != condition) continue;
    const record::Objective one = ledger::objective_of(record);
    if (!one.is_distance) all = {.is_distance = false, .unit = all.unit, .title = one.title};
    if (one.unit.empty()) all.unit.clear();
  }
  return all;
}

std::string StudyData::unit_of(std::string_view measure, std::string_view condition) const {
  return ledger::measure_unit(measure, objective(condition));
}

StudyData load_study_data(const std::filesystem::path& folder) {
  const ledger::StudyPaths paths(folder);
  StudyData data{.study = ledger::load_study_copy(paths), .records = {}, .unknown_files = {}};
  const ledger::Ledger kept(paths);
  data.records = kept.load_all(data.study);
  for (const auto& unknown : kept.unknown_files(data.study))
    data.unknown_files.push_back(io::printable(unknown.filename().string()));
  return data;
}

namespace {

/// Names of the figures that some run's map has.
std::set<std::string> map_figures_of(const StudyData& data) {
  std::set<std::string> names;
  for (const ledger::Record& record : data.records)
    for (const auto& [name, value] : record.map_figures) names.insert(name);
  return names;
}

}  // namespace

std::vector<std::string> measures_of(const StudyData& data) {
  std::vector<std::string> measures = ledger::measures_of_runs();
  const auto of_maps = map_figures_of(data);
  measures.insert(measures.end(), of_maps.begin(), of_maps.end());
  for (const ledger::TestSpec& test : data.study.tests)
    std::ranges::move(ledger::measures_of(test), std::back_inserter(measures));
  return measures;
}

std::vector<std::string> compared_measures_of(const StudyData& data) {
  std::vector<std::string> measures = ledger::compared_measures_of_runs();
  const auto of_maps = map_figures_of(data);
  measures.insert(measures.end(), of_maps.begin(), of_maps.end());
  for (const ledger::TestSpec& test : data.study.tests)
    std::ranges::move(ledger::compared_measures_of(test), std::back_inserter(measures));
  return measures;
}

ClaimsWritten claims_written(const StudyData& data) {
  std::map<std::string, std::size_t> by_hash;
  for (const ledger::Record& record : data.records) ++by_hash[record.provenance.claims];
  ClaimsWritten written;
  for (const auto& [hash, count] : by_hash)
    if (const auto rules = data.study.rules_of(hash))
      written.under.push_back({*rules, count});
    else
      written.differently += count;
  return written;
}

std::string rules_text(const ledger::JudgingRules& rules) {
  return fmt::format("verdict rules {} and stop rule {}", rules.verdicts, rules.stop);
}

namespace {

/// Whether two conditions that evolve for themselves gave the same champions with each seed that both have.
bool gave_the_same(const StudyData& data, const ledger::ConditionSpec& a, const ledger::ConditionSpec& b) {
  if (a.gaits != b.gaits || a.steering != b.steering) return false;
  std::size_t pairs = 0;
  for (const ledger::Record* one : data.runs(a.name))
    for (const ledger::Record* other : data.runs(b.name)) {
      if (one->seed != other->seed) continue;
      ++pairs;
      const auto genome = one->champion.find("genome"), its = other->champion.find("genome");
      if (genome == one->champion.end() || its == other->champion.end() || *genome != *its) return false;
    }
  return pairs >= 2;
}

void remark_on_equal_conditions(const StudyData& data, std::vector<std::string>& remarks) {
  const auto& conditions = data.study.conditions;
  for (std::size_t j = 0; j < conditions.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (gave_the_same(data, conditions[i], conditions[j]))
        remarks.push_back(fmt::format(
            "Conditions {} and {} gave the same champions with the same seeds: what differs between them has "
            "no effect on evolution, and what is found between them is no finding.",
            io::printable(conditions[i].name), io::printable(conditions[j].name)));
}

void remark_on_claims(const StudyData& data, std::vector<std::string>& remarks) {
  const ClaimsWritten written = claims_written(data);
  if (written.differently > 0)
    remarks.push_back(fmt::format(
        "The claims were changed after runs had finished: {} of {} records were made when they were "
        "others.",
        written.differently, data.records.size()));
  for (const auto& [rules, count] : written.under)
    if (rules != ledger::current_rules)
      remarks.push_back(fmt::format(
          "The claims of {} of {} records were written under {} and are judged here under {}: the "
          "same sentences, other rules, of which docs/STUDIES.md says what changed and why.",
          count, data.records.size(), rules_text(rules), rules_text(ledger::current_rules)));
}

}  // namespace

std::vector<std::string> remarks(const StudyData& data) {
  std::vector<std::string> remarks;
  if (const std::string missing = missing_runs(data); !missing.empty())
    remarks.push_back(
        fmt::format("The study is not finished: {} of {} runs are in ({}). Every number and "
                    "verdict on this page is of these runs and may change with the others.",
                    data.records.size(), data.planned(), missing));
  if (const auto others = std::ranges::count_if(
          data.records, [&](const ledger::Record& record) { return record.study != data.study.name; });
      others > 0)
    remarks.push_back(fmt::format("{} of {} records are of a study of another name than {}.", others,
                                  data.records.size(), io::printable(data.study.name)));
  for (const ledger::ConditionSpec& condition : data.study.conditions)
    remark_on_condition(data, condition, remarks);
  if (std::ranges::any_of(data.records, [&](const ledger::Record& run) {
        return ledger::score_of(run) != ledger::score_of(data.records.front());
      }))
    remarks.push_back(
        "Conditions were evolved by different scores; what they got in evolution cannot be compared.");
  remark_on_equal_conditions(data, remarks);
  for (const ledger::TestSpec& test : data.study.tests) remark_on_test(data, test, remarks);
  if (!data.study.claims.empty()) remark_on_claims(data, remarks);
  if (!data.unknown_files.empty())
    remarks.push_back(fmt::format("The ledger has {} that {} no run of this study and not counted: {}.",
                                  data.unknown_files.size() == 1 ? "a file" : "files",
                                  data.unknown_files.size() == 1 ? "is" : "are",
                                  fmt::join(data.unknown_files, ", ")));
  return remarks;
}

}  // namespace amble::report
