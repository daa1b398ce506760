#include <fmt/format.h>

#include "amble/io/xml.hpp"
#include "amble/record/levels.hpp"
#include "amble/report/html.hpp"
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
    const std::string_view meaning =
        level == nullptr ? std::string_view("one exact trial, as it was evolved or tested") : level->meaning;
    text += fmt::format("{}“{}”: {}", text.empty() ? "" : "; ", disturbance_name(column), meaning);
  }
  return text + ".";
}

}  // namespace

std::string typical_section(const Report& report) {
  std::string content;
  for (const TypicalTable& typical : report.typical) {
    content += subtitle(fmt::format("In {}{}", time_text(typical.trial_s),
                                    typical.engine.empty() ? "" : " in the engine " + typical.engine));
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

}  // namespace amble::report
