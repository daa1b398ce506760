#include <fmt/format.h>

#include "amble/core/index.hpp"
#include "amble/figures/svg.hpp"
#include "amble/io/quoting.hpp"
#include "amble/record/levels.hpp"
#include "amble/report/html.hpp"
#include "amble/report/mutants_figure.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/survival_figure.hpp"
#include "amble/report/typical_figure.hpp"

namespace amble::report {
namespace {

/// "6.97 [6.41, 7.52]" and below it how many of the trials fell.
std::string cell_of(const TypicalPoint* point) {
  if (point == nullptr) return "–";
  const int decimals = point->summary.mean < 10.0 ? 2 : 1;
  std::string text = number_text(point->summary.mean, decimals);
  if (point->summary.mean_interval) text += " " + interval_text(*point->summary.mean_interval, decimals);
  if (point->fell_share)
    text += fmt::format("<br/><small>fell: {}</small>", percent_text(*point->fell_share));
  return tied(text);
}

std::string table_of(const Report& report, const TypicalTable& typical) {
  std::vector<Column> columns{{"Condition", false}};
  for (const TypicalTable::Column& column : typical.columns)
    columns.push_back({fmt::format("{}, m", disturbance_name(column))});
  TableWriter table(columns);
  for (const TypicalCurve& curve : typical.curves) {
    std::vector<std::string> cells{fmt::format("{} <small>n = {}</small>",
                                               io::escape_xml(report.label(curve.condition)),
                                               curve.points.back().summary.n)};
    for (std::size_t column = 0; column < typical.columns.size(); ++column)
      cells.push_back(cell_of(curve.at(column)));
    table.row_of_markup(cells);
  }
  return table.finish();
}

/// What the columns are: "control: pushes too weak to change a bit: 1e-20 m/s".
std::string levels_text(const TypicalTable& typical) {
  std::string text;
  for (const TypicalTable::Column& column : typical.columns) {
    const record::Level* const level = record::find_level(column.level);
    std::string_view meaning = "one exact trial, as it was evolved or tested";
    if (level != nullptr) meaning = level->meaning;
    if (column.level == record::own_noise) meaning = "noise as in evolution, which it has not met";
    text += fmt::format("{}“{}”: {}", text.empty() ? "" : "; ", disturbance_name(column), meaning);
  }
  return text + ".";
}

std::string mean_text(const Report& report, const std::string& measure, const std::string& condition,
                      bool as_percent) {
  const auto* sample = find_summary(report.summaries, measure, condition);
  if (sample == nullptr) return "–";
  const auto& summary = sample->summary;
  return as_percent ? share_text(summary.mean, summary.mean_interval)
                    : estimate_text(summary.mean, summary.mean_interval, "");
}

std::string mutants_summary(const Report& report, const std::string& test) {
  TableWriter table(
      {{"Condition", false}, {"Runs"}, {"Viable [95 %]"}, {"Score kept [95 %]"}, {"Change of gait [95 %]"}});
  for (const auto& condition : report.data.study.conditions)
    if (const auto* viable = find_summary(report.summaries, test + ".viable_share", condition.name))
      table.row({condition.label(), fmt::format("{}", viable->summary.n),
                 mean_text(report, test + ".viable_share", condition.name, true),
                 mean_text(report, test + ".mutants_kept", condition.name, true),
                 mean_text(report, test + ".gait_change", condition.name, false)});
  return table.finish();
}

/// "10 s, 0.25 m", to be broken at the comma alone.
std::string rule_text(const score::StandingRule& rule) {
  return fmt::format("{}\u00A0s, {}\u00A0m", figures::number(rule.window_s), figures::number(rule.radius_m));
}

/// "compatible by 9 of 9 rules", "confirmed by 3 of 9, not confirmed by 6".
std::string verdicts_text(const StopCounts& counts) {
  std::string text;
  for (std::size_t verdict = 0; verdict < verdict_names.size(); ++verdict) {
    std::size_t rules = 0;
    for (std::size_t rule = 0; rule < stop_rules.size(); ++rule)
      rules += counts.runs[rule] && counts.verdicts[rule] == static_cast<Verdict>(verdict);
    if (rules > 0) text += fmt::format("{}{} by {}", text.empty() ? "" : ", ", verdict_names[verdict], rules);
  }
  return text;
}

std::string row_text(const Report& report, const StopCounts& counts) {
  const std::string& label = report.label(counts.condition);
  if (!counts.claim) return label;
  return fmt::format("Claim {}: {}, {} s or more", *counts.claim + 1, label,
                     figures::number(counts.at_least_s));
}

std::string test_table(const Report& report, const std::string& test) {
  std::vector<Column> columns{{"Walk to the end", false}, {"Runs"}, {"As metered"}};
  for (const auto& rule : stop_rules) columns.push_back({rule_text(rule)});
  columns.push_back({"Verdicts", false});
  TableWriter table(columns);
  std::size_t rows = 0;
  for (const StopCounts& counts : report.stops) {
    if (counts.test != test) continue;
    ++rows;
    std::vector<std::string> cells{row_text(report, counts), fmt::format("{}", counts.n),
                                   fmt::format("{}", counts.metered)};
    for (const auto& runs : counts.runs) cells.push_back(runs ? fmt::format("{}", *runs) : "–");
    cells.push_back(counts.claim ? verdicts_text(counts) : "");
    table.row(cells);
  }
  return rows == 0 ? std::string() : table.finish();
}

}  // namespace

std::string typical_section(const Report& report) {
  std::string content;
  for (const TypicalTable& typical : report.typical) {
    content += subtitle(fmt::format("In {}{}{}", time_text(typical.trial_s),
                                    typical.engine.empty() ? "" : " in the engine " + typical.engine,
                                    typical.as_in.empty() ? "" : ", as in the test " + typical.as_in));
    content += paragraph(levels_text(typical));
    if (typical.columns.size() > 1)
      content += figure([&](figures::FigureSize layout) { return typical_figure(report, typical, layout); },
                        "Small points: the typical distance of each champion. Line: their median with its "
                        "BCa interval. Grey: the medians of the others.");
    content += table_of(report, typical);
  }
  if (content.empty()) return {};
  return section(
      "typical", "What a walker typically does",
      "A single undisturbed trial is one exact trajectory; a walk is what remains when the start differs a "
      "little. A champion’s typical distance is the median of its trials at a level of disturbance. In the "
      "tables: means over champions with Student’s 95 % intervals, and how many of all trials fell.",
      content);
}

std::string mutants_section(const Report& report) {
  std::string content;
  for (const ledger::TestSpec& test : report.data.study.tests) {
    if (!has_mutants(report, test.name)) continue;
    content += subtitle("Test " + test.name);
    content += paragraph(fmt::format(
        "{} of each champion, in the same trials of {} as the champion; scores and duty factors are means "
        "over {}.",
        counted(static_cast<std::size_t>(test.mutants), "mutant"), time_text(test.seconds),
        counted(static_cast<std::size_t>(test.episodes), "episode")));
    content +=
        figure([&](figures::FigureSize layout) { return mutants_figure(report, test.name, layout); },
               "To the right: how much of the champion’s score a mutant keeps. Up: how far its gait "
               "differs, as the mean over the legs of the differences in duty factor. Darker: more "
               "mutants; at the edges are those beyond. Right of the line they are viable; their share is "
               "behind each name.");
    content += mutants_summary(report, test.name);
  }
  if (content.empty()) return {};
  return section("mutants", "What a mutation makes of them",
                 "Mutants of the champions, one mutation each, as in evolution: evolvability signatures "
                 "(Tarapore & Mouret 2015). A mutant is viable if it keeps at least half of the champion’s "
                 "score. In the table, means over runs of: the share of viable mutants; the share of the "
                 "score that the median mutant keeps; the change of the gait of viable mutants.",
                 content);
}

std::string stop_rules_section(const Report& report) {
  std::string content;
  for (const ledger::TestSpec& test : report.data.study.tests)
    if (const std::string table = test_table(report, test.name); !table.empty())
      content += subtitle("Test " + test.name) + paragraph(test_text(report, test) + ".") + table;
  if (content.empty()) return {};
  return section(
      "stops", "What counts as a stop",
      "How many champions walk to the end of a test, or for as long as a claim says, if standing still is to "
      "stay within a radius for so many seconds. The rule of the ledgers is 10 s within 0.25 m, metered ten "
      "times a second; the others, and that one again, are computed from the path in the records. Each "
      "champion counts by its first trial, in the section “Still walking” by its middle one. Paths have one "
      "point per second in tests of 300 s, and can miss a step out of the radius or the beginning of a stop.",
      content);
}

}  // namespace amble::report
