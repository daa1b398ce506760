#include <fmt/format.h>

#include <algorithm>

#include "amble/io/quoting.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

using io::escape_xml;

/// More conditions than this get a matrix besides the list of all pairs.
constexpr std::size_t most_listed = 8;
constexpr double level = 0.05;

std::string summary_table(const Report& report, const std::string& measure) {
  TableWriter table(
      {{"Condition", false}, {"Runs"}, {"Mean [95 %]"}, {"sd"}, {"Median [BCa]"}, {"IQM [BCa]"}});
  const auto of = [](double value, const std::optional<statistics::BootstrapInterval>& found) {
    return estimate_text(value, found ? std::optional(found->interval) : std::nullopt, "");
  };
  for (const ledger::ConditionSpec& condition : report.data.study.conditions)
    if (const auto* sample = find_summary(report.summaries, measure, condition.name)) {
      const auto& summary = sample->summary;
      table.row({condition.label(),
                 summary.n == sample->planned ? fmt::format("{}", summary.n)
                                              : fmt::format("{} of {}", summary.n, sample->planned),
                 estimate_text(summary.mean, summary.mean_interval, ""),
                 summary.sd ? number_text(*summary.sd) : "–", of(summary.median, sample->median),
                 of(summary.interquartile_mean, sample->interquartile_mean)});
    }
  return table.finish();
}

template <typename Test>
std::string p_cell(const std::optional<AdjustedTest<Test>>& test) {
  if (!test) return "–";
  return fmt::format("{}<br/><small>Holm </small><span{}>{}</span>", escape_xml(p_number(test->test.p)),
                     test->p_holm < level ? " class=\"significant\"" : "",
                     escape_xml(p_number(test->p_holm)));
}

std::string pair_table(const Report& report, const PairTable& pairs) {
  TableWriter table({{"Pair", false},
                     {"Difference of means [95 %]"},
                     {"Student, p"},
                     {"Welch, p"},
                     {"Mann–Whitney, p"},
                     {"A12 [95 %]"}});
  for (const Pair& pair : pairs.pairs) {
    const auto& superiority = pair.superiority;
    table.row_of_markup(
        {fmt::format("{} <small>−</small> {}", escape_xml(report.label(pair.first)),
                     escape_xml(report.label(pair.second))),
         pair.welch ? tied(estimate_text(pair.welch->test.difference, pair.welch->test.interval, "")) : "–",
         p_cell(pair.student), p_cell(pair.welch), p_cell(pair.mann_whitney),
         superiority
             ? fmt::format("{} {}", number_text(superiority->a12, 2), interval_text(superiority->interval, 2))
             : "–"});
  }
  return table.finish();
}

/// Differences of means, row minus column; those significant by Welch's test after adjustment stand out.
std::string matrix(const Report& report, const PairTable& pairs) {
  std::vector<std::string> conditions;
  for (const auto& condition : report.data.study.conditions) conditions.push_back(condition.name);
  std::vector<Column> columns{{"", false}};
  for (std::size_t i = 0; i < conditions.size(); ++i) columns.push_back({fmt::format("{}", i + 1)});
  TableWriter table(columns, "dense matrix");
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    std::vector<std::string> cells{
        fmt::format("{} {}", i + 1, escape_xml(fitted(report.label(conditions[i]), 150.0)))};
    for (const std::string& other : conditions) {
      const auto found = std::ranges::find_if(pairs.pairs, [&](const Pair& pair) {
        return (pair.first == conditions[i] && pair.second == other) ||
               (pair.second == conditions[i] && pair.first == other);
      });
      if (found == pairs.pairs.end() || !found->welch) {
        cells.emplace_back();
        continue;
      }
      const double difference = found->welch->test.difference * (found->first == conditions[i] ? 1.0 : -1.0);
      cells.push_back(fmt::format("<span{}>{}</span>",
                                  found->welch->p_holm < level ? " class=\"significant\"" : "",
                                  number_text(difference, difference > -99.5 && difference < 99.5 ? 1 : 0)));
    }
    table.row_of_markup(cells);
  }
  return paragraph(
             "Row minus column, difference of means; bold: significant at 0.05 by Welch’s test after Holm’s "
             "adjustment.") +
         table.finish();
}

}  // namespace

std::string pairs_section(const Report& report) {
  const bool many = report.data.study.conditions.size() > most_listed;
  const std::string evolution =
      fmt::format("{} in evolution{}", report.objective_title(), report.objective.unit.empty() ? "" : ", m");
  std::string content;
  for (const std::string& measure : compared_measures_of(report.data)) {
    if (std::ranges::none_of(report.summaries, [&](const auto& sample) { return sample.measure == measure; }))
      continue;
    std::string part = summary_table(report, measure);
    const auto found = std::ranges::find(report.pairs, measure, &PairTable::measure);
    if (found == report.pairs.end())
      part += paragraph("No two conditions have two runs each: too few for any test.", "note");
    else if (many)
      part += matrix(report, *found) +
              folded(fmt::format("All {} pairs", found->pairs.size()), pair_table(report, *found));
    else
      part += pair_table(report, *found);
    content +=
        folded(measure == "train_m" ? evolution : ledger::measure_label(measure), part, measure == "train_m");
  }
  return section(
      "pairs", "Every pair of conditions",
      fmt::format("Two-sided tests of all pairs in every {}distance and figure of a map: Student’s t (the "
                  "paper’s), Welch’s t, Mann–Whitney. ",
                  report.objective.is_distance ? "" : "score, ") +
          "Below each p value is the one adjusted by Holm’s method; the family is all pairs of one measure "
          "under one test. A12 is the probability that a run of the first condition beats one of the second. "
          "The interval of a difference is Welch’s; IQM is the interquartile mean; BCa intervals, "
          "from six runs on, come of 10 000 resamples with a fixed seed.",
      content);
}

}  // namespace amble::report
