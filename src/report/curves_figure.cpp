#include "amble/report/curves_figure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

using figures::Box;
using figures::FigureSize;
using figures::Point;
using figures::Scale;
using figures::Svg;

/// Room for the median at the end of a panel's title.
constexpr double median_width_px = 54.0;

/// Every `stride`-th point and the last.
std::vector<Point> line(const BestCurve& curve, const std::vector<double>& values, const Scale& x,
                        const Scale& y, std::size_t stride = 1) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % stride == 0 || i + 1 == values.size()) points.push_back({x(curve.generation[i]), y(values[i])});
  return points;
}

void draw_panel(Svg& svg, const Report& report, const BestCurve& curve, const PanelGrid& grid,
                const Box& plot, const Scale& x, const Scale& y) {
  const bool is_small = plot.width < 200;
  figures::draw_y_axis(svg, y, figures::nice_ticks(y.data, is_small ? 4 : 5), plot.x, plot.right(),
                       report.objective.unit);
  figures::draw_x_axis(svg, x, figures::nice_ticks(x.data, is_small ? 3 : 5, 1.0), plot.bottom(), "");
  for (const BestCurve& other : report.curves)
    if (&other != &curve)
      svg.polyline(line(other, other.median_m, x, y, other.median_m.size() > 60 ? 3 : 1), "other");

  const std::string median = number_text(curve.median_m.back()) + report.data.objective(curve.condition).unit;
  svg.begin_group("strip " + figures::leg_class(report.index(curve.condition)),
                  fmt::format("{}: median {} after generation {}", report.label(curve.condition), median,
                              curve.generation.back()));
  auto band = line(curve, curve.upper_quartile_m, x, y);
  auto below = line(curve, curve.lower_quartile_m, x, y);
  std::ranges::reverse(below);
  band.insert(band.end(), below.begin(), below.end());
  svg.polygon(band, "band");
  svg.polyline(line(curve, curve.median_m, x, y), "curve");
  svg.end_group();
  draw_panel_title(svg, grid, plot, report.label(curve.condition), median, median_width_px);
}

}  // namespace

std::string curves_figure(const Report& report, FigureSize layout) {
  const auto& curves = report.curves;
  AMBLE_CHECK(!curves.empty(), "a curve");
  PanelGrid grid = PanelGrid::of(curves.size(), layout);
  std::vector<std::string> labels;
  labels.reserve(curves.size());
  for (const BestCurve& curve : curves) labels.push_back(report.label(curve.condition));
  grid.make_room(labels, median_width_px);
  double last = 1.0, best = 0.0;
  for (const BestCurve& curve : curves) {
    last = std::max(last, static_cast<double>(curve.generation.back()));
    best = std::max(best, *std::ranges::max_element(curve.upper_quartile_m));
  }
  const figures::Interval generations{0.0, last}, distances{0.0, best > 0.0 ? 1.04 * best : 1.0};
  Svg svg(width_px(layout), grid.height_px(),
          fmt::format("{} of the champion so far over {} generations, median and quartiles of {} conditions",
                      report.objective.is_distance ? "Distance" : "Score", static_cast<int>(last) + 1,
                      curves.size()));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Box plot = grid.plot(i);
    draw_panel(svg, report, curves[i], grid, plot, Scale{generations, plot.x, plot.right()},
               Scale{distances, plot.bottom(), plot.y});
  }
  return svg.finish();
}

}  // namespace amble::report
