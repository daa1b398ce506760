#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "amble/io/quoting.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/tables.hpp"

namespace amble::report {
namespace {

using io::escape_xml;

/// Whole numbers with runs of neighbours drawn together: "1–20, 25".
std::string ranges_text(std::vector<std::int64_t> numbers) {
  std::ranges::sort(numbers);
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (last > i) text += (last == i + 1 ? ", " : "–") + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

std::string conditions_table(const Report& report) {
  TableWriter table({{"Condition", false},
                     {"Config and settings", false},
                     {"Seeds", false},
                     {"Runs"},
                     {"Generations"},
                     {"Engine", false},
                     {"Settings’ hash", false}});
  for (const ledger::ConditionSpec& condition : report.data.study.conditions) {
    const auto runs = report.data.runs(condition.name);
    std::string settings = config_text(condition.config);
    for (const std::string& setting : condition.settings) settings += ", " + setting;
    table.row({condition.label(), settings, ranges_text(report.data.study.seeds_of(condition)),
               fmt::format("{}", runs.size()),
               runs.empty() ? "–" : fmt::format("{}", runs.front()->generations),
               runs.empty() ? "–" : runs.front()->engine, runs.empty() ? "–" : runs.front()->config});
  }
  return table.finish();
}

/// "0123456789ab"; with "+" if there were changes that were not committed.
std::string short_commit(const std::string& commit) {
  constexpr std::size_t length = 12;
  return commit.substr(0, length) + (commit.ends_with('+') && commit.size() > length ? "+" : "");
}

/// Builds and machines that made the records.
std::string builds_table(const Report& report) {
  struct Build {
    std::size_t runs = 0;
    double seconds = 0.0;
    std::string first, last;
  };
  std::map<std::array<std::string, 5>, Build> builds;
  std::map<std::pair<std::string, std::string>, std::size_t> added;  ///< test and commit: runs
  for (const ledger::Record& record : report.data.records) {
    const auto& made = record.provenance;
    Build& build = builds[{made.version, made.commit, made.compiler, made.flags, made.cpu}];
    ++build.runs;
    build.seconds += made.evolution_s + made.tests_s;
    if (build.first.empty() || made.finished_utc < build.first) build.first = made.finished_utc;
    build.last = std::max(build.last, made.finished_utc);
    for (const auto& [test, commit] : made.added_by)
      if (report.data.result(record, test) != nullptr) ++added[{test, commit}];
  }
  TableWriter table({{"Build", false},
                     {"Compiler and flags", false},
                     {"Processor", false},
                     {"Runs"},
                     {"Hours"},
                     {"Finished", false}});
  for (const auto& [key, build] : builds)
    table.row({fmt::format("amble {} ({})", key[0], short_commit(key[1])), key[2] + ", " + key[3], key[4],
               fmt::format("{}", build.runs), fmt::format("{:.2f}", build.seconds / 3600.0),
               build.first == build.last ? build.first : build.first + " to " + build.last});
  for (const auto& [key, runs] : added)
    table.row({fmt::format("amble ({})", short_commit(key.second)),
               fmt::format("test {}, added later", key.first), "–", fmt::format("{}", runs), "–", "–"});
  return table.finish();
}

std::string tests_table(const Report& report) {
  if (report.data.study.tests.empty()) return {};
  TableWriter table({{"Test", false}, {"Trials", false}, {"Conditions", false}});
  for (const ledger::TestSpec& test : report.data.study.tests)
    table.row({test.name, test_text(report, test),
               test.conditions.empty() ? "all" : fmt::format("{}", fmt::join(test.conditions, ", "))});
  return table.finish();
}

std::string files_table(const Report& report) {
  TableWriter table({{"File", false}, {"A row is", false}, {"Rows"}}, "dense");
  for (const Table& file : tables(report))
    table.row({file.name + ".csv", file.about, fmt::format("{}", file.rows.size())});
  return table.finish();
}

}  // namespace

std::string provenance_section(const Report& report) {
  const auto& study = report.data.study;
  std::string content = "<pre>";
  content += escape_xml(
      fmt::format("amble study FILE.toml --out DIR    # or go on with: amble study DIR/study.toml --out DIR\n"
                  "amble report DIR -o report.html --csv FOLDER --json report.json --figures FOLDER\n"));
  content += "</pre>\n";
  content += subtitle("Conditions");
  if (!study.settings.empty())
    content += paragraph(fmt::format("Settings of all conditions: {}.", fmt::join(study.settings, ", ")));
  content += conditions_table(report);
  if (!study.tests.empty()) content += subtitle("Tests of the champions") + tests_table(report);
  if (!report.data.records.empty()) content += subtitle("Builds and machines") + builds_table(report);
  content +=
      subtitle("Where the numbers are") +
      paragraph(
          "Every number on this page is in these tables, in full precision; runs.csv and bests.csv have "
          "what the others are computed from. The JSON document has the same tables.") +
      files_table(report);
  return section(
      "made", "How this was made",
      fmt::format(
          "From the study file and the ledger alone: study {}, ledger digest {}. The same ledger gives "
          "this page again to the byte.",
          study.name, report.digest),
      content);
}

}  // namespace amble::report
