#include <fmt/format.h>

#include "amble/core/index.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"

namespace amble::report {
namespace {

/// "10 s, 0.25 m", to be broken at the comma alone.
std::string rule_text(const score::StandingRule& rule) {
  return fmt::format("{}\u00A0s, {}\u00A0m", figures::number(rule.window_s), figures::number(rule.radius_m));
}

/// "compatible by 9 of 9 rules", "confirmed by 3 of 9, not confirmed by 6".
std::string verdicts_text(const StopCounts& counts) {
  std::string text;
  for (std::size_t verdict = 0; verdict < verdict_names.size(); ++verdict) {
    const auto rules = std::ranges::count(counts.verdicts, static_cast<Verdict>(verdict));
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
    for (const std::size_t runs : counts.runs) cells.push_back(fmt::format("{}", runs));
    cells.push_back(counts.claim ? verdicts_text(counts) : "");
    table.row(cells);
  }
  return rows == 0 ? std::string() : table.finish();
}

}  // namespace

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
      "times a second; the others, and that one again, are computed from the path of the first episode in "
      "the "
      "records, one point per second in tests of 300 s, which can miss a step out of the radius or the "
      "beginning of a stop.",
      content);
}

}  // namespace amble::report
