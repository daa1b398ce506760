#include "amble/report/page.hpp"

#include <fmt/format.h>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "amble/figures/style_sheet.hpp"
#include "amble/io/quoting.hpp"
#include "amble/page/html_page.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"

namespace amble::report {
namespace {

using io::escape_xml;

/// "800" or "300 to 800".
std::string range_text(const std::set<int>& values) {
  if (values.empty()) return "–";
  if (values.size() == 1) return fmt::format("{}", *values.begin());
  return fmt::format("{} to {}", *values.begin(), *values.rbegin());
}

std::string headline_number(std::string_view name, std::string_view value, std::string_view more = {}) {
  return fmt::format("<div><dt>{}</dt><dd>{}{}</dd></div>\n", escape_xml(name), escape_xml(value),
                     more.empty() ? "" : fmt::format(" <small>{}</small>", escape_xml(more)));
}

std::string headline(const Report& report) {
  std::set<int> generations, seeds;
  std::set<std::string> engines, commits;
  for (const auto& condition : report.data.study.conditions)
    seeds.insert(static_cast<int>(report.data.study.seeds_of(condition).size()));
  for (const ledger::Record& record : report.data.records) {
    generations.insert(record.generations);
    engines.insert(record.engine);
    commits.insert(record.provenance.commit);
  }
  std::string out = "<dl class=\"numbers\">\n";
  out += headline_number("Conditions", fmt::format("{}", report.data.study.conditions.size()));
  out += headline_number("Seeds each", range_text(seeds));
  out += headline_number("Generations", range_text(generations));
  out += headline_number("Runs in the ledger", fmt::format("{}", report.data.records.size()),
                         fmt::format("of {}", report.data.planned()));
  out += headline_number(engines.size() > 1 ? "Engines" : "Engine",
                         engines.empty() ? "–" : fmt::format("{}", fmt::join(engines, ", ")));
  return out + "</dl>\n";
}

/// Says so if the claims were the same when each run finished, and by which rules they are judged.
std::string claims_text(const Report& report) {
  const auto& data = report.data;
  if (data.study.claims.empty() || data.records.empty()) return {};
  const std::string rules = rules_text(ledger::current_rules);
  const ClaimsWritten written = claims_written(data);
  if (written.differently > 0) return fmt::format(" Claims are judged by {}.", rules);
  if (written.under.size() == 1 && written.under[0].rules == ledger::current_rules)
    return fmt::format(
        " The claims and the rules that judge them ({}) were the same when each run finished ({}).", rules,
        data.study.claims_hash());
  return fmt::format(
      " The claims were the same, word for word, when each run finished; they are judged by {}.", rules);
}

std::string header(const Report& report) {
  std::set<std::string> builds;
  for (const ledger::Record& record : report.data.records) builds.insert(record.provenance.commit);
  const std::string subtitle =
      fmt::format("Study {}, ledger digest {}, made by {}.{}", report.data.study.name, report.digest,
                  counted(builds.size(), "build"), claims_text(report));
  return fmt::format(
      "<header>\n<p class=\"kicker\">amble report</p>\n<h1>{}</h1>\n<p "
      "class=\"subtitle\">{}</p>\n</header>\n",
      escape_xml(report.title()), escape_xml(subtitle));
}

std::string remarks_box(const Report& report) {
  if (report.remarks.empty()) return {};
  std::string out = "<div class=\"remarks\">\n";
  for (const std::string& remark : report.remarks) out += paragraph(remark);
  return out + "</div>\n";
}

struct Part {
  std::string_view anchor, name;
  std::string content;
};

std::string contents(const std::vector<Part>& parts) {
  std::string out = "<nav aria-label=\"Contents\">\n";
  for (const Part& part : parts)
    if (!part.content.empty())
      out += fmt::format("<a href=\"#{}\">{}</a>\n", part.anchor, escape_xml(part.name));
  return out + "</nav>\n";
}

constexpr std::string_view figures = R"css(
.strip .bar { fill: currentColor; opacity: .38; }
.strip .run { fill: currentColor; opacity: .85; stroke: var(--paper); stroke-width: .6; }
.strip.base .bar { fill: var(--mid); opacity: .4; }
.strip.base .run { fill: var(--mid); }
.whisker { stroke: var(--ink); stroke-width: 1.5; }
.strip .band { fill: currentColor; opacity: .2; }
.strip .curve { stroke: currentColor; stroke-width: 2; stroke-linejoin: miter; }
.other { fill: none; stroke: var(--line); stroke-width: 1; opacity: .8; }
.lead { stroke: currentColor; stroke-width: 1; opacity: .7; }
)css";

constexpr std::string_view text = R"css(
:root { --good: #00705f; --bad: #b23a06; --open: #7a5b00; --near: #2f5f9e; --void: #5d6670; }
@media screen and (prefers-color-scheme: dark) {
  :root { --good: #45c2b0; --bad: #ff8a54; --open: #e4b54a; --near: #8db4ea; --void: #98a2ad; }
}
h3 { margin: 44px 0 0; font-size: 17px; line-height: 1.35; font-weight: 640; }
h4 { margin: 26px 0 0; font-size: 15px; font-weight: 600; } h4 + p { margin: 2px 0 0; color: var(--soft); font-size: 14.5px; }
h3 + p, section > p + p, summary + p { max-width: 44rem; margin: 6px 0 0; color: var(--soft); }
h3 + figure { margin-top: 14px; }
figcaption { margin-top: 8px; color: var(--soft); font-size: 13.5px; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; margin-top: 30px; font-size: 14.5px; }
nav a { color: var(--soft); text-underline-offset: 3px; }
.remarks { margin-top: 34px; padding: 14px 18px; background: var(--panel); border-left: 3px solid var(--open); border-radius: 0 8px 8px 0; font-size: 14.5px; }
.remarks p { margin: 0; } .remarks p + p { margin-top: 8px; }
.verdicts { display: flex; flex-wrap: wrap; gap: 8px 26px; margin: 20px 0 0; padding: 0; list-style: none; font-size: 17px; }
.verdicts b { font-size: 26px; font-weight: 640; letter-spacing: -.015em; }
.share { display: flex; height: 8px; margin-top: 12px; gap: 2px; }
.share i { border-radius: 2px; background: var(--tone); }
.confirmed { --tone: var(--good); } .compatible { --tone: var(--near); } .not-confirmed { --tone: var(--open); } .contradicted { --tone: var(--bad); } .not-testable { --tone: var(--line); }
.not-testable .verdict, .verdicts .not-testable { color: var(--void); }
.verdict { color: var(--tone); font-weight: 640; white-space: nowrap; }
.verdict.not-testable { color: var(--void); }
.verdict::before { display: inline-block; width: 1.3em; }
.verdict.confirmed::before { content: "\2713"; } .verdict.compatible::before { content: "\2248"; } .verdict.not-confirmed::before { content: "\25CB"; }
.verdict.contradicted::before { content: "\2715"; } .verdict.not-testable::before { content: "\2013"; }

.data { font-size: 14px; line-height: 1.45; }
.data th, .data td { padding: 7px 0 7px 18px; width: auto; color: var(--ink); overflow-wrap: normal; }
.data th:first-child, .data td:first-child { padding-left: 0; }
.data thead th { border-top: 0; color: var(--soft); font-size: 13px; font-weight: 450; vertical-align: bottom; padding-bottom: 6px; }
.data tbody th { font-weight: 550; padding-right: 0; }
.data .number { text-align: right; white-space: nowrap; }
.data small { color: var(--soft); font-size: 12.5px; }
.data .significant { font-weight: 680; }
.claims .index { width: 2rem; font-weight: 450; color: var(--soft); }
.claims .sentence { width: 37%; } .claims .published { width: 13%; } .claims .here { width: 23%; }
.claims .test { width: 12%; } .claims .judged { white-space: nowrap; }
.claims .reason { display: block; margin-top: 3px; color: var(--soft); font-size: 13px; }
.claims .p { white-space: nowrap; }
.data thead .number { white-space: normal; }
.scroll { overflow-x: auto; margin-top: 20px; } .scroll > table { margin-top: 0; }
.data.matrix { font-size: 11.5px; } .data.matrix th, .data.matrix td { padding: 4px 0 4px 5px; } .data.matrix tbody th { white-space: nowrap; font-size: 12px; }
.data tbody th small { font-weight: 450; white-space: nowrap; }
.count { display: block; min-width: 34px; }
.count i { display: block; height: 4px; margin-top: 3px; margin-left: auto; border-radius: 2px; background: var(--leg); }
details { margin-top: 18px; border-top: 1px solid var(--hair); padding-top: 12px; }
summary { cursor: pointer; font-weight: 600; font-size: 15.5px; }
details .scroll { margin-top: 14px; } details .scroll + .scroll { margin-top: 30px; }
)css";

constexpr std::string_view phone_and_paper = R"css(
@media screen and (max-width: 900px) {
  .data { font-size: 13px; } .data th, .data td { padding-left: 12px; }
}
@media screen and (max-width: 700px) {
  .data { font-size: 12.5px; } .data th, .data td { padding-left: 9px; } .dense thead th { font-size: 11.5px; } .dense th, .dense td { padding-left: 6px; } .count { min-width: 22px; }
  .cards { font-size: 14px; } .cards thead { display: none; }
  .cards, .cards tbody, .cards tr, .cards th, .cards td { display: block; width: auto; }
  .cards tr { padding: 12px 0; border-top: 1px solid var(--hair); }
  .cards tr:last-child { border-bottom: 1px solid var(--hair); }
  .cards th, .cards td, .cards tr:last-child > * { padding: 1px 0; border: 0; }
  .cards td { display: grid; grid-template-columns: minmax(7.5rem, 38%) 1fr; gap: 12px; }
  .cards td::before { content: attr(data-title); text-align: left; color: var(--soft); font-size: 13px; }
  .cards td.number { white-space: normal; } .cards th.number { text-align: left; }
  .cards td:has(> div:empty) { display: none; }
  .claims tbody tr { display: flex; flex-direction: column; position: relative; padding-left: 2rem; }
  .claims .index { position: absolute; left: 0; top: 12px; }
  .claims td, .claims th, .claims .sentence, .claims .published, .claims .here, .claims .test { width: auto; }
  .claims td { grid-template-columns: 5rem 1fr; order: 3; }
  .claims td.sentence, .claims td.judged { display: block; } .claims td.sentence::before, .claims td.judged::before { content: none; }
  .claims td.sentence { font-size: 15px; order: 1; } .claims td.judged { order: 2; padding: 4px 0 6px; }
}
@media print {
  :root { color-scheme: light; }
  nav { display: none; }
  section { break-inside: auto; } h2, h3 { break-after: avoid; } figure, tr { break-inside: avoid; }
  details::details-content { content-visibility: visible; display: block; }
  .data { font-size: 8.5pt; } .data thead th, .data small, .claims .reason { font-size: 8pt; } .data th, .data td { padding-top: 3pt; padding-bottom: 3pt; }
  .scroll { overflow: visible; } .data th, .data td { padding-left: 9pt; } .data.matrix { font-size: 6pt; } .data.matrix th, .data.matrix td { padding: 2pt 0 2pt 2pt; } .data.matrix tbody th { font-size: 6.5pt; }
}
)css";

}  // namespace

std::string make_page(const Report& report) {
  std::vector<Part> parts;
  parts.push_back({"claims", "Claims", claims_section(report)});
  if (!report.data.records.empty()) {
    parts.push_back({"distance", report.objective_title(), distance_section(report)});
    parts.push_back({"typical", "Typical", typical_section(report)});
    parts.push_back({"curves", "Curves", curves_section(report)});
    parts.push_back({"survival", "Falls and stops", survival_section(report)});
    parts.push_back({"stops", "Stop rules", stop_rules_section(report)});
    parts.push_back({"sizes", "CPPNs", sizes_section(report)});
    parts.push_back({"gaits", "Gaits", gaits_section(report)});
    parts.push_back({"mutants", "Mutants", mutants_section(report)});
    parts.push_back({"transfer", "Other engines", transfer_section(report)});
    parts.push_back({"pairs", "Pairs", pairs_section(report)});
  }
  parts.push_back({"made", "How this was made", provenance_section(report)});
  std::string body = header(report) + headline(report) + remarks_box(report) + contents(parts);
  for (const Part& part : parts) body += part.content;
  return page::html_page(report.title(), style_sheet(), body);
}

std::string style_sheet() {
  std::string sheet = figures::style_sheet();
  for (const std::string_view part : {figures, text, phone_and_paper}) sheet += part;
  return sheet;
}

std::string standalone_figure(std::string element) {
  return figures::standalone_svg(std::move(element), figures);
}

}  // namespace amble::report
