#include "amble/report/page_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/figures/svg.hpp"
#include "amble/io/quoting.hpp"
#include "amble/record/levels.hpp"
#include "amble/report/curves_figure.hpp"
#include "amble/report/figures.hpp"
#include "amble/report/html.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/survival_figure.hpp"

namespace amble::report {
namespace {

using figures::FigureSize;

std::string_view name_of(Activity activity) {
  return activity_names[to_index(activity)];
}

/// "mean (sd)".
std::string mean_sd(const SampleSummary* sample) {
  if (sample == nullptr) return "–";
  const auto& summary = sample->summary;
  if (!summary.sd) return number_text(summary.mean, 1);
  return fmt::format("{} ({})", number_text(summary.mean, 1), number_text(*summary.sd, 1));
}

std::string log_rank_text(const SurvivalTable& table) {
  if (const auto& test = table.log_rank) {
    const std::string text =
        fmt::format("Log-rank test across {} conditions: χ² = {}, {} df, {}", table.conditions.size(),
                    number_text(test->chi_square), test->degrees_of_freedom, p_text(test->p));
    if (!test->exact_p) return text + ".";
    return text +
           fmt::format("; by all ways to deal out so few runs, which counts, {}.", p_text(*test->exact_p));
  }
  const bool any_ended =
      std::ranges::any_of(table.conditions, [](const auto& condition) { return condition.curve.ended > 0; });
  return any_ended ? "One condition alone: no log-rank test."
                   : "All runs lasted to the end of the test: nothing to compare.";
}

/// "47 s [30, 120]"; an end that the band never reaches is beyond the test.
std::string median_text(const statistics::SurvivalCurve& curve, double trial_s) {
  if (!curve.median_s) return "beyond " + time_text(trial_s);
  const auto end = [](const std::optional<double>& value) { return value ? number_text(*value) : "–"; };
  return fmt::format("{} s [{}, {}]", number_text(*curve.median_s), end(curve.median_lower_s),
                     end(curve.median_upper_s));
}

std::string survival_part(const Report& report, const SurvivalTable& table) {
  const bool upright = table.activity == Activity::upright;
  TableWriter rows({{"Condition", false},
                    {"Runs"},
                    {upright ? "Fell" : "Stopped"},
                    {"Lasted"},
                    {upright ? "Median time upright" : "Median time walking"}},
                   "dense");
  for (const ConditionLifetimes& condition : table.conditions)
    rows.row({report.label(condition.condition), fmt::format("{}", condition.curve.n),
              fmt::format("{}", condition.curve.ended), percent_text(condition.curve.at(table.trial_s)),
              median_text(condition.curve, table.trial_s)});
  std::string out = fmt::format("<h4>Still {}</h4>\n", name_of(table.activity));
  out += paragraph(log_rank_text(table));
  out += figure([&](FigureSize layout) { return survival_figure(report, table, layout); });
  return out + rows.finish();
}

/// What there is to say of one test. Tests in other engines are folded: they repeat the others.
std::string test_part(const Report& report, const std::string& test, std::string_view what,
                      std::string_view content) {
  const bool elsewhere =
      std::ranges::any_of(report.transfers, [&](const Transfer& transfer) { return transfer.test == test; });
  if (elsewhere) return folded(fmt::format("{} in test {}", what, test), content);
  return subtitle("Test " + test) + std::string(content);
}

/// Gaits as columns, conditions as rows; each count with a bar of its share.
std::string gait_table(const Report& report, const GaitTable& gaits) {
  std::vector<Column> columns{{"Condition", false}};
  for (const std::string& gait : gaits.gaits) columns.push_back({gait});
  TableWriter table(columns, "dense");
  for (const GaitCounts& counts : gaits.rows) {
    std::vector<std::string> cells{
        fmt::format("{} <small>n = {}</small>", io::escape_xml(report.label(counts.condition)), counts.n)};
    for (const std::string& gait : gaits.gaits) {
      const std::size_t runs = counts.count(gait);
      cells.push_back(
          runs == 0 ? "<span class=\"count\"><small>0</small></span>"
                    : fmt::format("<span class=\"count {}\">{}<i style=\"width: {}%\"></i></span>",
                                  figures::leg_class(report.index(counts.condition)), runs,
                                  figures::number(
                                      100.0 * static_cast<double>(runs) / static_cast<double>(counts.n), 0)));
    }
    table.row_of_markup(cells);
  }
  return table.finish();
}

}  // namespace

std::string config_text(const std::string& path) {
  const auto folder = path.find("configs/");
  return path.substr(folder == std::string::npos ? path.find_last_of('/') + 1 : folder);
}

std::string test_text(const Report& report, const ledger::TestSpec& test) {
  std::vector<std::string> engines;
  for (const ledger::Record& record : report.data.records)
    if (const auto* result = report.data.result(record, test.name);
        result && std::ranges::find(engines, result->engine) == engines.end())
      engines.push_back(result->engine);
  std::string text = time_text(test.seconds);
  if (!engines.empty())
    text +=
        fmt::format(" in the {} {}", engines.size() == 1 ? "engine" : "engines", fmt::join(engines, ", "));
  if (!test.ground.empty()) text += ", on the ground of " + config_text(test.ground);
  if (!test.damage.empty()) text += ", with the damage of " + config_text(test.damage);
  const std::string episodes = counted(to_index(test.episodes), "episode");
  if (test.level == record::own_noise)
    text += fmt::format(", {} under the noise of its own evolution, which it has not met (median)", episodes);
  else if (!test.level.empty())
    text += fmt::format(", {} at the level {} (median)", episodes, test.level);
  else if (!test.noise.empty())
    text += fmt::format(", {} under noise that evolution has not met (median)", episodes);
  else if (test.episodes > 1)
    text += fmt::format(", {} (median)", episodes);
  return text;
}

std::string distance_section(const Report& report) {
  const auto training = training_rows(report);
  std::string content = figure([&](FigureSize layout) {
    return rows_figure(training, report.objective.unit,
                       fmt::format("{} in evolution, all conditions", report.objective_title()), layout);
  });
  for (const ledger::TestSpec& test : report.data.study.tests) {
    const auto rows = test_rows(report, test.name);
    if (rows.empty()) continue;
    const bool compared =
        std::ranges::any_of(rows, [](const StripRow& row) { return row.strips.size() > 1; });
    const std::string grey = compared ? " Grey: the same champions’ distance in evolution." : "";
    content += test_part(report, test.name, "Distance",
                         paragraph(test_text(report, test) + "." + grey) + figure([&](FigureSize layout) {
                           return rows_figure(rows, " m", "Distance in test " + test.name, layout);
                         }));
  }
  return section("distance", report.objective.is_distance ? "How far they walked" : "What they reached",
                 fmt::format("{} of each run’s champion in its evolution. Bars are means with Student’s 95 % "
                             "intervals, each point is a run.",
                             report.objective_title()),
                 content);
}

std::string curves_section(const Report& report) {
  return section(
      "curves", "How they learned",
      fmt::format(
          "The {} of each run’s champion so far, in its evaluation, over the generations: median and "
          "quartiles over the runs of a condition, in grey the medians of the others. It may fall where "
          "trials of their own decide on champions (champion.episodes).",
          report.objective.name()),
      figure([&](FigureSize layout) { return curves_figure(report, layout); }));
}

std::string survival_section(const Report& report) {
  std::string content;
  for (const ledger::TestSpec& test : report.data.study.tests) {
    std::string parts;
    for (const SurvivalTable& table : report.survival)
      if (table.is_long && table.test == test.name) parts += survival_part(report, table);
    if (!parts.empty())
      content += test_part(report, test.name, "Time upright and walking",
                           paragraph(test_text(report, test) + ".") + parts);
  }
  if (content.empty()) return {};
  return section(
      "survival", "How long they stayed up and walked",
      "Kaplan–Meier curves of tests longer than evolution’s trials: the share of runs still "
      "upright or walking. Upright ends with a fall, walking also by standing still; what lasts to the "
      "end of the test is censored there. Medians have the interval of Brookmeyer and Crowley; "
      "“–” is an end beyond the test.",
      content);
}

std::string sizes_section(const Report& report) {
  TableWriter table({{"Condition", false}, {"Runs"}, {"Hidden nodes, mean (sd)"}, {"Links, mean (sd)"}},
                    "dense");
  for (const ledger::ConditionSpec& condition : report.data.study.conditions) {
    const auto* hidden = find_summary(report.summaries, "hidden", condition.name);
    const auto* links = find_summary(report.summaries, "links", condition.name);
    if (hidden != nullptr)
      table.row({condition.label(), fmt::format("{}", hidden->summary.n), mean_sd(hidden), mean_sd(links)});
  }
  return section("sizes", "The champions’ CPPNs",
                 "Hidden nodes and enabled links of the compositional pattern producing networks.",
                 table.finish());
}

std::string gaits_section(const Report& report) {
  std::string content;
  for (const GaitTable& gaits : report.gaits)
    content += test_part(report, gaits.test, "Gaits", gait_table(report, gaits));
  if (content.empty()) return {};
  return section("gaits", "Gaits", "Runs by the name of their champion’s gait (docs/GAIT.md).", content);
}

std::string transfer_section(const Report& report) {
  if (report.transfers.empty()) return {};
  TableWriter table({{"Condition", false},
                     {"Test", false},
                     {"Engine", false},
                     {"Runs"},
                     {"Median distance"},
                     {"Share kept, median"},
                     {"Compared with", false}});
  for (const Transfer& transfer : report.transfers)
    table.row({report.label(transfer.condition), transfer.test, transfer.home + " → " + transfer.engine,
               fmt::format("{}", transfer.n), number_text(transfer.median_m) + " m",
               transfer.share
                   ? share_text(*transfer.share, transfer.share_interval
                                                     ? std::optional(transfer.share_interval->interval)
                                                     : std::nullopt)
                   : "–",
               transfer.reference == "train_m" ? "evolution"
               : transfer.reference.empty()
                   ? "–"
                   : "test " + transfer.reference.substr(0, transfer.reference.find('.'))});
  return section(
      "transfer", "In other engines",
      "The same champions in engines they were not evolved in. The share kept is the median over runs of "
      "the distance there by the distance at home in trials of the same length, with a BCa interval.",
      table.finish());
}

}  // namespace amble::report
