#include "amble/report/typical_figure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/panels.hpp"
#include "amble/report/rows_figure.hpp"
#include "amble/report/survival_figure.hpp"

namespace amble::report {
namespace {

using figures::Box;
using figures::FigureSize;
using figures::Point;
using figures::Scale;
using figures::Svg;

constexpr double run_radius_px = 2.3, median_radius_px = 3.6, swarm_px = 13.0, value_width_px = 92.0;

/// One column of panels on phones: names of disturbances need the width.
PanelGrid make_grid(const std::vector<std::string>& labels, FigureSize layout) {
  PanelGrid grid;
  grid.below_px = 42.0;
  const std::size_t most = layout == FigureSize::wide ? 3 : 1;
  grid.columns = labels.size() == 4 && most > 1 ? 2 : std::clamp<std::size_t>(labels.size(), 1, most);
  grid.rows = (labels.size() + grid.columns - 1) / grid.columns;
  grid.panel_width_px = std::min(figures::width_px(layout) / static_cast<double>(grid.columns), 480.0) -
                        grid.left_px - grid.gap_px;
  grid.panel_height_px = std::clamp(0.6 * grid.panel_width_px, 120.0, 190.0);
  grid.make_room(labels, value_width_px);
  return grid;
}

struct TypicalFrame {
  const Report& report;
  const TypicalTable& table;
  Box plot;
  Scale y;

  double x(std::size_t column) const {
    const double each = plot.width / static_cast<double>(table.columns.size());
    return plot.x + (static_cast<double>(column) + 0.5) * each;
  }
};

void draw_axes(Svg& svg, const TypicalFrame& frame) {
  figures::draw_y_axis(svg, frame.y, figures::nice_ticks(frame.y.data, 5), frame.plot.x, frame.plot.right(),
                       " m");
  const double base = frame.plot.bottom();
  svg.line({frame.plot.x, base}, {frame.plot.right(), base}, "axis");
  for (std::size_t column = 0; column < frame.table.columns.size(); ++column)
    svg.text({frame.x(column), base + 19}, figures::Anchor::middle, "tick",
             disturbance_name(frame.table.columns[column]));
}

std::vector<Point> medians(const TypicalFrame& frame, const TypicalCurve& curve) {
  std::vector<Point> points;
  for (const TypicalPoint& point : curve.points)
    points.push_back({frame.x(point.column), frame.y(point.summary.median)});
  return points;
}

/// The champions of one point, a little left of its place, and the interval of their median.
void draw_point(Svg& svg, const TypicalFrame& frame, const TypicalPoint& point) {
  const double x = frame.x(point.column);
  std::vector<double> places;
  for (const double distance_m : point.distances_m) places.push_back(frame.y(distance_m));
  const auto offsets = beeswarm(places, run_radius_px, swarm_px);
  for (std::size_t i = 0; i < places.size(); ++i)
    svg.circle({x + offsets[i], places[i]}, run_radius_px, "run");
  if (!point.median) return;
  const double lower = frame.y(point.median->interval.lower), upper = frame.y(point.median->interval.upper);
  svg.line({x, lower}, {x, upper}, "whisker");
  for (const double end : {lower, upper}) svg.line({x - 4.0, end}, {x + 4.0, end}, "whisker");
}

/// "7.0 → 2.0 m" of the first and the last column that the condition has.
std::string change_text(const TypicalCurve& curve) {
  const auto text = [](const TypicalPoint& point) { return number_text(point.summary.median, 1); };
  if (curve.points.size() == 1) return text(curve.points.front()) + " m";
  return text(curve.points.front()) + " → " + text(curve.points.back()) + " m";
}

void draw_panel(Svg& svg, const TypicalFrame& frame, const PanelGrid& grid, const TypicalCurve& curve) {
  const Report& report = frame.report;
  draw_axes(svg, frame);
  for (const TypicalCurve& other : frame.table.curves)
    if (&other != &curve) svg.polyline(medians(frame, other), "other");
  const std::string& label = report.label(curve.condition);
  svg.begin_group("strip " + figures::leg_class(report.index(curve.condition)),
                  fmt::format("{}: median {}", label, change_text(curve)));
  const auto line = medians(frame, curve);
  for (const TypicalPoint& point : curve.points) draw_point(svg, frame, point);
  svg.polyline(line, "curve");
  for (const Point& at : line) svg.circle(at, median_radius_px, "run");
  svg.end_group();
  draw_panel_title(svg, grid, frame.plot, label, change_text(curve), value_width_px);
}

}  // namespace

std::string typical_figure(const Report& report, const TypicalTable& table, FigureSize layout) {
  AMBLE_CHECK(!table.curves.empty(), "a curve");
  std::vector<std::string> labels;
  double most_m = 0.0;
  for (const TypicalCurve& curve : table.curves) {
    labels.push_back(report.label(curve.condition));
    for (const TypicalPoint& point : curve.points) most_m = std::max(most_m, point.summary.maximum);
  }
  const PanelGrid grid = make_grid(labels, layout);
  const figures::Interval distances{0.0, most_m > 0.0 ? 1.04 * most_m : 1.0};
  Svg svg(width_px(layout), grid.height_px(),
          fmt::format("Typical distance in {} against the size of the disturbance, {} conditions",
                      time_text(table.trial_s), table.curves.size()));
  for (std::size_t i = 0; i < table.curves.size(); ++i) {
    const Box plot = grid.plot(i);
    draw_panel(svg, {report, table, plot, Scale{distances, plot.bottom(), plot.y}}, grid, table.curves[i]);
  }
  return svg.finish();
}

}  // namespace amble::report
