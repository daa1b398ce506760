#include <fmt/format.h>

#include "amble/report/html.hpp"
#include "amble/report/mutants_figure.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/survival_figure.hpp"

namespace amble::report {
namespace {

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

}  // namespace

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

}  // namespace amble::report
