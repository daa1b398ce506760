#include "amble/figures/fitness_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

struct Curve {
  std::string_view name;
  const std::vector<double>& values;
  std::string_view css_class;
};

/// What curves are drawn over, one number per generation.
struct Abscissa {
  std::string_view name;
  std::vector<double> values;
};

/// Generations; or, of a map, the evaluations up to the end of each, by which maps are compared.
Abscissa abscissa_of(const record::Generations& generations) {
  if (generations.coverage.empty() || generations.evaluations.empty())
    return {"generation", generations.generation};
  std::vector<double> evaluations(generations.evaluations);
  std::partial_sum(evaluations.begin(), evaluations.end(), evaluations.begin());
  const double all = evaluations.back();
  const double unit = all >= 2e6 ? 1e6 : all >= 2e3 ? 1e3 : 1.0;
  for (double& count : evaluations) count /= unit;
  return {unit == 1e6   ? "million evaluations"
          : unit == 1e3 ? "thousand evaluations"
                        : "evaluations",
          std::move(evaluations)};
}

/// A plot's area and scales.
struct Panel {
  Box plot;
  Scale x, y;
};

Panel make_panel(const Box& plot, const Abscissa& abscissa, Interval values) {
  Interval span{abscissa.values.front(), abscissa.values.back()};
  if (span.length() <= 0.0) span.upper = span.lower + 1.0;
  if (values.length() <= 0.0) values.upper = values.lower + 1.0;
  return {plot, Scale{span, plot.x, plot.right()}, Scale{values, plot.bottom(), plot.y}};
}

/// From zero, or lower if the data is, to a little above the largest value.
Interval value_range(std::initializer_list<const std::vector<double>*> columns) {
  Interval range{0.0, 0.0};
  for (const auto* column : columns)
    for (const double value : *column) range = including(range, value);
  range.upper += 0.06 * range.length();
  return range;
}

/// From each column of pixels the first, the lowest, the highest and the last point: what is drawn is
/// the same, and a curve over ten thousand generations is as long as the picture is wide.
std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    while (end < points.size() && std::floor(points[end].x) == std::floor(points[begin].x)) ++end;
    const auto column = std::span(points).subspan(begin, end - begin);
    const auto [highest, lowest] = std::ranges::minmax_element(column, {}, &Point::y);
    const std::set<std::size_t> chosen{0, static_cast<std::size_t>(highest - column.begin()),
                                       static_cast<std::size_t>(lowest - column.begin()), column.size() - 1};
    for (const std::size_t i : chosen) kept.push_back(column[i]);
  }
  return kept;
}

std::vector<Point> curve_points(const Panel& panel, const Abscissa& abscissa,
                                const std::vector<double>& values) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i)
    points.push_back({panel.x(abscissa.values[i]), panel.y(values[i])});
  return thinned(points);
}

void draw_curve(Svg& svg, const Panel& panel, const Abscissa& abscissa, const Curve& curve) {
  const auto points = curve_points(panel, abscissa, curve.values);
  svg.polyline(points, "curve " + std::string(curve.css_class));
  svg.circle(points.back(), 3.5, "dot " + std::string(curve.css_class));
}

/// Between the quartiles of what the champion typically does.
std::vector<Point> band_points(const Panel& panel, const Abscissa& abscissa,
                               const record::Generations& generations) {
  auto band = curve_points(panel, abscissa, generations.typical_upper);
  const auto lower = curve_points(panel, abscissa, generations.typical_lower);
  band.insert(band.end(), lower.rbegin(), lower.rend());
  return band;
}

void draw_objectives(Svg& svg, const record::Generations& generations, const Abscissa& abscissa,
                     const Box& plot, const std::string& unit) {
  std::vector<Curve> curves{{"median", generations.median, "median"}, {"mean", generations.mean, "mean"}};
  const bool has_typical = generations.typical.size() == generations.count();
  if (has_typical) curves.push_back({"typical", generations.typical, "typical"});
  curves.push_back({"best", generations.best, "best"});
  const Panel panel = make_panel(
      plot, abscissa,
      value_range({&generations.best, &generations.mean, &generations.median, &generations.typical_upper}));
  draw_y_axis(svg, panel.y, nice_ticks(panel.y.data, 6), plot.x, plot.right(), unit);
  draw_x_axis(svg, panel.x, nice_ticks(panel.x.data, plot.width > 500 ? 9 : 5, 1.0), plot.bottom(), "");
  svg.text({plot.right() + 14, plot.bottom() + 19}, Anchor::start, "tick", abscissa.name);

  auto area = curve_points(panel, abscissa, generations.best);
  area.push_back({area.back().x, panel.y(panel.y.data.lower)});
  area.push_back({area.front().x, panel.y(panel.y.data.lower)});
  svg.polygon(area, "under-best");
  if (has_typical) svg.polygon(band_points(panel, abscissa, generations), "quartiles");

  std::vector<double> label_px;
  for (const Curve& curve : curves) {
    draw_curve(svg, panel, abscissa, curve);
    label_px.push_back(panel.y(curve.values.back()));
  }
  spread(label_px, 17.0);
  for (std::size_t i = 0; i < curves.size(); ++i)
    svg.text({plot.right() + 14, label_px[i] + 4}, Anchor::start, "label " + std::string(curves[i].css_class),
             fmt::format("{} {}{}", curves[i].name, label(curves[i].values.back(), 2), unit));
}

void draw_small(Svg& svg, const Abscissa& abscissa, const Box& plot, std::string_view title,
                const std::vector<double>& values, int decimals) {
  const Panel panel = make_panel(plot, abscissa, value_range({&values}));
  svg.text({plot.x - 26, plot.y - 12}, Anchor::start, "title", title);
  svg.text({plot.right(), plot.y - 12}, Anchor::end, "value", label(values.back(), decimals));
  const Ticks ticks = nice_ticks(panel.y.data, 4, decimals == 0 ? 1.0 : 0.0);
  draw_y_axis(svg, panel.y, ticks, plot.x, plot.right(), "");
  draw_x_axis(svg, panel.x, nice_ticks(panel.x.data, plot.width > 150 ? 5 : 3, 1.0), plot.bottom(), "");
  draw_curve(svg, panel, abscissa, {title, values, "small"});
}

}  // namespace

std::string fitness_figure(const record::Generations& generations, FigureSize layout,
                           const record::Objective& objective) {
  AMBLE_CHECK(generations.count() > 0, "a run has a generation");
  const bool wide = layout == FigureSize::wide;
  const double width = width_px(layout);
  const double main_height = wide ? 300 : 220, small_height = wide ? 96 : 72;
  const double small_top = main_height + 90;
  Svg svg(width, small_top + small_height + 30,
          fmt::format("{0} over {2} generations: best {3}{1}, mean {4}{1}, median {5}{1} in the last",
                      objective.title, objective.unit, generations.count(), label(generations.best.back(), 2),
                      label(generations.mean.back(), 2), label(generations.median.back(), 2)));
  const Abscissa abscissa = abscissa_of(generations);
  draw_objectives(svg, generations, abscissa, {42, 12, width - 42 - 114, main_height}, objective.unit);

  struct Small {
    std::string_view wide_title, narrow_title;
    const std::vector<double>& values;
    int decimals;
  };
  const std::array<Small, 6> smalls{{{"Species", "Species", generations.species, 0},
                                     {"Hidden nodes, mean", "Nodes", generations.mean_hidden, 1},
                                     {"Links, mean", "Links", generations.mean_links, 1},
                                     {"Share of cells filled", "Filled", generations.coverage, 3},
                                     {"QD score", "QD score", generations.qd_score, 0},
                                     {"Best of the map", "Best", generations.map_best, 2}}};
  const double gap = wide ? 28 : 10, left = 26;
  const double each = (width - 2 * gap - 10) / 3 - left;
  int shown = 0;
  for (const Small& small : smalls) {
    if (small.values.empty()) continue;  // a search without such a column
    draw_small(svg, abscissa, {left + shown++ * (left + each + gap), small_top, each, small_height},
               wide ? small.wide_title : small.narrow_title, small.values, small.decimals);
  }
  return svg.finish();
}

}  // namespace amble::figures
