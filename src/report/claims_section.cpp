#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"

namespace amble::report {
namespace {

using io::escape_xml;

std::string css_class(Verdict verdict) {
  std::string name(name_of(verdict));
  std::ranges::replace(name, ' ', '-');
  return name;
}

/// How many claims got which verdict, in words and as a bar.
std::string verdict_counts(const Report& report) {
  const auto counts = count_verdicts(report.judgements);
  std::string list = "<ul class=\"verdicts\">", bar = "<div class=\"share\" aria-hidden=\"true\">";
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string name = css_class(static_cast<Verdict>(i));
    list += fmt::format("<li class=\"{}\"><b>{}</b> <span class=\"verdict {}\">{}</span></li>\n", name,
                        counts[i], name, verdict_names[i]);
    if (counts[i] > 0) bar += fmt::format("<i class=\"{}\" style=\"flex: {}\"></i>", name, counts[i]);
  }
  return list + "</ul>\n" + bar + "</div>\n";
}

std::string runs_text(const Judgement& judgement) {
  const auto of = [](std::size_t n, std::size_t planned) {
    return n == planned ? fmt::format("{}", n) : fmt::format("{} of {}", n, planned);
  };
  std::string text = "n = " + of(judgement.n, judgement.planned);
  if (judgement.planned_against > 0) text += " and " + of(judgement.n_against, judgement.planned_against);
  return text;
}

std::string test_cell(const Judgement& judgement) {
  if (judgement.test.empty()) return {};
  std::string cell = escape_xml(judgement.test);
  if (judgement.p)
    cell += "<br/>" + fmt::format("<span class=\"p\">{}</span>", escape_xml(p_text(*judgement.p)));
  if (judgement.p_holm)
    cell += fmt::format("<br/><small class=\"p\">Holm {}</small>", escape_xml(p_number(*judgement.p_holm)));
  if (judgement.p_spread)
    cell +=
        fmt::format("<br/><small class=\"p\">spread {}</small>", escape_xml(p_number(*judgement.p_spread)));
  if (judgement.p_equivalence)
    cell += fmt::format("<br/><small class=\"p\">{} {}</small>",
                        judgement.p_spread ? "equivalence" : "not inferior",
                        escape_xml(p_number(*judgement.p_equivalence)));
  return cell;
}

/// Whether somebody else has published what the claim says.
bool has_published_figure(const ledger::ClaimSpec& claim) {
  return !claim.figure.empty() && claim.source != "amble";
}

/// Which claims' p values are adjusted together; `families`: tests by relation.
std::string families_text(const std::array<std::size_t, 2>& families) {
  const auto [greater, not_less] = families;
  if (greater + not_less < 2) return {};
  if (not_less == 0 || greater == 0)
    return fmt::format(
        " Claims of differences are one family of {}, whose p values are adjusted by Holm’s method.",
        counted(greater + not_less, "test"));
  return fmt::format(
      " Claims that one condition is ahead are one family of {}, claims that it is not behind another of {}: "
      "the p "
      "values of each are adjusted by Holm’s method.",
      counted(greater, "test"), not_less);
}

}  // namespace

std::string claims_section(const Report& report) {
  const auto& claims = report.data.study.claims;
  if (claims.empty()) return {};
  const bool published = std::ranges::any_of(claims, has_published_figure);
  std::vector<Column> columns{{"No.", false, "index"}, {"Claim", false, "sentence"}};
  if (published) columns.push_back({"Published", false, "published"});
  columns.insert(columns.end(),
                 {{"Here", false, "here"}, {"Test", false, "test"}, {"Verdict", false, "judged"}});
  TableWriter table(columns, "cards claims");
  const bool one_source = std::ranges::all_of(
      claims, [&](const ledger::ClaimSpec& claim) { return claim.source == claims[0].source; });
  std::array<std::size_t, 2> families{};
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const ledger::ClaimSpec& claim = claims[i];
    const Judgement& judgement = report.judgements[i];
    if (judgement.p_holm) ++families.at(to_index(claim.relation));
    const std::string source = claim.source.empty() || one_source
                                   ? ""
                                   : fmt::format("<br/><small>{}</small>", escape_xml(claim.source));
    const std::string ours = judgement.ours.empty() ? "" : tied(escape_xml(judgement.ours)) + "<br/>";
    std::vector<std::string> cells{fmt::format("{}", i + 1),
                                   fmt::format("{}{}<span class=\"reason\">{}</span>", escape_xml(claim.text),
                                               source, tied(escape_xml(judgement.reason)))};
    if (published) cells.push_back(has_published_figure(claim) ? tied(escape_xml(claim.figure)) : "");
    cells.insert(cells.end(),
                 {fmt::format("{}<small>{}</small>", ours, runs_text(judgement)), test_cell(judgement),
                  fmt::format("<span class=\"verdict {}\">{}</span>", css_class(judgement.verdict),
                              name_of(judgement.verdict))});
    table.row_of_markup(cells);
  }
  std::string lead =
      "Each claim is judged by the rule given with it in the study’s file (docs/STUDIES.md). Intervals "
      "are at 95 %, but those of a mean against a published one at 1 − alpha of the claim.";
  if (one_source && !claims[0].source.empty()) lead = fmt::format("From {}. ", claims[0].source) + lead;
  lead += families_text(families);
  return section("claims", "The claims", lead, verdict_counts(report) + table.finish());
}

}  // namespace amble::report
