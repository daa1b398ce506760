#include "amble/report/comparisons.hpp"

#include <algorithm>
#include <cmath>

#include "amble/ledger/measures.hpp"
#include "amble/report/study_data.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {
namespace {

/// Adjusts the p values of one test over all pairs that have it.
template <typename Test>
void adjust(std::vector<Pair>& pairs, std::optional<AdjustedTest<Test>> Pair::*member) {
  std::vector<double> p;
  for (const Pair& pair : pairs)
    if (pair.*member) p.push_back((pair.*member)->test.p);
  const auto adjusted = statistics::holm(p);
  std::size_t next = 0;
  for (Pair& pair : pairs)
    if (pair.*member) (pair.*member)->p_holm = adjusted[next++];
}

template <typename Test>
std::optional<AdjustedTest<Test>> unadjusted(const std::optional<Test>& test) {
  if (!test) return std::nullopt;
  return AdjustedTest<Test>{*test};
}

Pair compare(const ledger::ConditionSpec& first, const ledger::ConditionSpec& second,
             const std::vector<double>& a, const std::vector<double>& b) {
  return {.first = first.name,
          .second = second.name,
          .n_first = a.size(),
          .n_second = b.size(),
          .student = unadjusted(statistics::student_t_test(a, b, confidence)),
          .welch = unadjusted(statistics::welch_t_test(a, b, confidence)),
          .mann_whitney = unadjusted(statistics::mann_whitney(a, b)),
          .superiority = statistics::vargha_delaney(a, b, confidence)};
}

/// Student's interval knows nothing of the ends of a share.
void cut_to_shares(statistics::Interval& interval) {
  interval.lower = std::max(interval.lower, 0.0);
  interval.upper = std::min(interval.upper, 1.0);
}

}  // namespace

std::vector<SampleSummary> summarize(const StudyData& data) {
  const auto compared = compared_measures_of(data);
  std::vector<SampleSummary> summaries;
  for (const std::string& measure : measures_of(data))
    for (const ledger::ConditionSpec& condition : data.study.conditions) {
      const auto values = data.values(condition.name, measure);
      // Where runs never got as far as a test asks, or went nowhere, there is no mean; the table of runs and
      // counts have them.
      if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) continue;
      auto summary = statistics::summarize(values, confidence);
      if (!summary) continue;
      if (summary->mean_interval && ledger::is_share(measure)) cut_to_shares(*summary->mean_interval);
      SampleSummary found{.measure = measure,
                          .condition = condition.name,
                          .planned = data.planned(condition.name),
                          .summary = *summary,
                          .median = {},
                          .interquartile_mean = {}};
      const bool is_compared = std::ranges::find(compared, measure) != compared.end();
      if (is_compared && values.size() >= fewest_resampled) {
        found.median = statistics::bootstrap(values, statistics::median);
        found.interquartile_mean = statistics::bootstrap(values, statistics::interquartile_mean);
      }
      summaries.push_back(std::move(found));
    }
  return summaries;
}

const SampleSummary* find_summary(const std::vector<SampleSummary>& summaries, std::string_view measure,
                                  std::string_view condition) {
  const auto found = std::ranges::find_if(summaries, [&](const SampleSummary& summary) {
    return summary.measure == measure && summary.condition == condition;
  });
  return found == summaries.end() ? nullptr : &*found;
}

std::vector<PairTable> compare_pairs(const StudyData& data) {
  const auto& conditions = data.study.conditions;
  std::vector<PairTable> tables;
  for (const std::string& measure : compared_measures_of(data)) {
    std::vector<std::vector<double>> samples;
    samples.reserve(conditions.size());
    for (const auto& condition : conditions) samples.push_back(data.values(condition.name, measure));
    PairTable table{.measure = measure, .pairs = {}};
    for (std::size_t i = 0; i < conditions.size(); ++i)
      for (std::size_t k = i + 1; k < conditions.size(); ++k)
        if (samples[i].size() >= 2 && samples[k].size() >= 2)
          table.pairs.push_back(compare(conditions[i], conditions[k], samples[i], samples[k]));
    if (table.pairs.empty()) continue;
    adjust(table.pairs, &Pair::student);
    adjust(table.pairs, &Pair::welch);
    adjust(table.pairs, &Pair::mann_whitney);
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace amble::report
