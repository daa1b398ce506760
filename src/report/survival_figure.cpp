#include "amble/report/survival_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

using figures::Anchor;
using figures::Box;
using figures::FigureSize;
using figures::Point;
using figures::Scale;
using figures::Svg;

constexpr std::size_t most_overlaid = figures::leg_colours;

/// Room for the share at the end of a panel's title.
constexpr double share_width_px = 48.0;

struct TimeUnit {
  double seconds;
  std::string_view name;
};
TimeUnit unit_for(double trial_s) {
  if (trial_s <= 600.0) return {1.0, " s"};
  if (trial_s <= 7200.0) return {60.0, " min"};
  return {3600.0, " h"};
}

struct SurvivalFrame {
  Box plot;
  double trial_s = 1.0;
  TimeUnit unit{1.0, ""};
  Scale x, y;

  double at(double time_s) const { return x(time_s / unit.seconds); }
};

SurvivalFrame make_frame(const Box& plot, double trial_s) {
  const TimeUnit unit = unit_for(trial_s);
  return {plot, trial_s, unit, Scale{{0.0, trial_s / unit.seconds}, plot.x, plot.right()},
          Scale{{0.0, 100.0}, plot.bottom(), plot.y}};
}

/// Constant between its steps, from 100 % at 0 to the end of the test.
std::vector<Point> staircase(const SurvivalFrame& frame, const statistics::SurvivalCurve& curve) {
  std::vector<Point> points{{frame.at(0.0), frame.y(100.0)}};
  for (const statistics::SurvivalStep& step : curve.steps) {
    if (step.ended == 0) continue;
    points.push_back({frame.at(step.time_s), points.back().y});
    points.push_back({frame.at(step.time_s), frame.y(100.0 * step.survival)});
  }
  points.push_back({frame.at(frame.trial_s), points.back().y});
  return points;
}

void draw_axes(Svg& svg, const SurvivalFrame& frame) {
  const bool is_small = frame.plot.width < 200;
  figures::draw_y_axis(svg, frame.y, {{0.0, 50.0, 100.0}, 50.0, 0}, frame.plot.x, frame.plot.right(), " %");
  figures::draw_x_axis(svg, frame.x, figures::nice_ticks(frame.x.data, is_small ? 3 : 7), frame.plot.bottom(),
                       frame.unit.name);
}

void draw_curve(Svg& svg, const Report& report, const SurvivalFrame& frame,
                const ConditionLifetimes& condition) {
  const double share = condition.curve.at(frame.trial_s);
  svg.begin_group("strip " + figures::leg_class(report.index(condition.condition)),
                  fmt::format("{}: {} at the end, {}", report.label(condition.condition), percent_text(share),
                              counted(condition.curve.n, "run")));
  svg.polyline(staircase(frame, condition.curve), "curve");
  svg.end_group();
}

std::string end_text(const Report& report, const SurvivalFrame& frame, const ConditionLifetimes& condition) {
  return fmt::format("{} {}", percent_text(condition.curve.at(frame.trial_s)),
                     fitted(report.label(condition.condition), 170.0));
}

/// Places for labels, apart from each other and within the bounds: figures::spread, then pushed back inside.
std::vector<double> spread_within(std::vector<double> places, double top, double bottom) {
  constexpr double gap = 17.0;
  figures::spread(places, gap);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
  double least = top;
  for (const std::size_t i : order) {
    places[i] = std::max(places[i], least);
    least = places[i] + gap;
  }
  double most = bottom;
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    places[*i] = std::min(places[*i], most);
    most = places[*i] - gap;
  }
  return places;
}

/// Names at the ends of the curves, moved apart, each tied to its end by a thin line.
void draw_end_labels(Svg& svg, const Report& report, const SurvivalTable& table, const SurvivalFrame& frame) {
  std::vector<double> places;
  for (const auto& condition : table.conditions)
    places.push_back(frame.y(100.0 * condition.curve.at(frame.trial_s)));
  const auto labels = spread_within(places, frame.plot.y, frame.plot.bottom() + 4.0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double x = frame.plot.right(), y = labels[i];
    svg.begin_group("strip " + figures::leg_class(report.index(table.conditions[i].condition)));
    svg.line({x + 2, places[i]}, {x + 16, y}, "lead");
    svg.line({x + 16, y}, {x + 26, y}, "curve");
    svg.end_group();
    svg.text({x + 32, y + 4}, Anchor::start, "label", end_text(report, frame, table.conditions[i]));
  }
}

/// Names below the picture, a line each.
void draw_key(Svg& svg, const Report& report, const SurvivalTable& table, const SurvivalFrame& frame) {
  double y = frame.plot.bottom() + 46;
  for (const auto& condition : table.conditions) {
    svg.begin_group("strip " + figures::leg_class(report.index(condition.condition)));
    svg.line({frame.plot.x, y - 4}, {frame.plot.x + 18, y - 4}, "curve");
    svg.end_group();
    svg.text({frame.plot.x + 26, y}, Anchor::start, "label",
             fitted(report.label(condition.condition), 210.0));
    svg.text({frame.plot.right(), y}, Anchor::end, "value", percent_text(condition.curve.at(frame.trial_s)));
    y += 19;
  }
}

std::string description(const SurvivalTable& table) {
  return fmt::format("Share of runs still {} over {} of test {}", activity_names[to_index(table.activity)],
                     time_text(table.trial_s), table.test);
}

std::string overlaid(const Report& report, const SurvivalTable& table, FigureSize layout) {
  const bool wide = layout == FigureSize::wide;
  const double width = width_px(layout), height = wide ? 230 : 170;
  const double key = wide ? 0.0 : 26.0 + 19.0 * static_cast<double>(table.conditions.size());
  Svg svg(width, 12 + height + 30 + key, description(table));
  const SurvivalFrame frame = make_frame({50, 12, width - 50 - (wide ? 240.0 : 10.0), height}, table.trial_s);
  draw_axes(svg, frame);
  for (const auto& condition : table.conditions) draw_curve(svg, report, frame, condition);
  wide ? draw_end_labels(svg, report, table, frame) : draw_key(svg, report, table, frame);
  return svg.finish();
}

std::string in_panels(const Report& report, const SurvivalTable& table, FigureSize layout) {
  PanelGrid grid = PanelGrid::of(table.conditions.size(), layout);
  grid.left_px = 46.0;
  grid.panel_width_px -= 12.0;
  std::vector<std::string> labels;
  for (const auto& condition : table.conditions) labels.push_back(report.label(condition.condition));
  grid.make_room(labels, share_width_px);
  Svg svg(width_px(layout), grid.height_px(), description(table));
  for (std::size_t i = 0; i < table.conditions.size(); ++i) {
    const auto& condition = table.conditions[i];
    const SurvivalFrame frame = make_frame(grid.plot(i), table.trial_s);
    draw_axes(svg, frame);
    for (const auto& other : table.conditions)
      if (&other != &condition) svg.polyline(staircase(frame, other.curve), "other");
    draw_curve(svg, report, frame, condition);
    draw_panel_title(svg, grid, frame.plot, report.label(condition.condition),
                     percent_text(condition.curve.at(table.trial_s)), share_width_px);
  }
  return svg.finish();
}

}  // namespace

std::string time_text(double time_s) {
  const TimeUnit unit = unit_for(time_s);
  return figures::number(time_s / unit.seconds, 1) + std::string(unit.name);
}

std::string survival_figure(const Report& report, const SurvivalTable& table, FigureSize layout) {
  return table.conditions.size() <= most_overlaid ? overlaid(report, table, layout)
                                                  : in_panels(report, table, layout);
}

}  // namespace amble::report
