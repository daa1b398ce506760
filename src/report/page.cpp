#include "amble/report/page.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "amble/io/xml.hpp"
#include "amble/page/html_page.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/page_style.hpp"

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

}  // namespace amble::report
