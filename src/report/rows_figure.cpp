#include "amble/report/rows_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

using figures::Anchor;
using figures::FigureSize;
using figures::Interval;
using figures::Scale;
using figures::Svg;

constexpr double bar_px = 11.0, points_px = 21.0, point_radius_px = 2.6, row_gap_px = 15.0;
constexpr double strip_px = bar_px + points_px, label_line_px = 19.0, narrow_label_px = 215.0;

struct StripFrame {
  FigureSize layout;
  double label_px = 0.0;           ///< room for the names of rows
  double left = 0.0, right = 0.0;  ///< of the plot
  Scale x;
};

Interval data_range(const std::vector<StripRow>& rows) {
  Interval range{0.0, 0.0};
  for (const StripRow& row : rows)
    for (const Strip& strip : row.strips) {
      for (const double value : strip.values) range = figures::including(range, value);
      if (strip.interval) {
        range = figures::including(range, strip.interval->lower);
        range = figures::including(range, strip.interval->upper);
      }
    }
  if (range.length() <= 0.0) range.upper = 1.0;
  range.upper += 0.02 * range.length();
  return range;
}

StripFrame make_strip_frame(const std::vector<StripRow>& rows, FigureSize layout, bool several) {
  const bool wide = layout == FigureSize::wide;
  double longest = 0.0;
  for (const StripRow& row : rows) longest = std::max(longest, label_width_px(row.label));
  const double label = wide ? std::clamp(longest, 60.0, 230.0) : narrow_label_px;
  StripFrame frame{.layout = layout, .label_px = label, .left = 0.0, .right = 0.0, .x = {}};
  frame.left = wide ? label + 16.0 + (several ? 66.0 : 0.0) : 0.0;
  frame.right = width_px(layout) - (wide ? 150.0 : several ? 118.0 : 4.0);
  frame.x = {data_range(rows), frame.left, frame.right};
  return frame;
}

/// Room for the name above a row on phones.
double label_height(const StripRow& row, FigureSize layout) {
  if (layout == FigureSize::wide) return 0.0;
  const double room = row.strips.size() > 1 ? width_px(layout) : narrow_label_px;
  return label_line_px + (label_width_px(row.label) > room ? 15.0 : 0.0);
}

double row_height(const StripRow& row, FigureSize layout) {
  return static_cast<double>(row.strips.size()) * strip_px + label_height(row, layout);
}

/// Where each row begins, and at last where the axis is.
std::vector<double> row_tops(const std::vector<StripRow>& rows, FigureSize layout) {
  std::vector<double> tops{8.0};
  for (const StripRow& row : rows) tops.push_back(tops.back() + row_height(row, layout) + row_gap_px);
  return tops;
}

void draw_strip(Svg& svg, const StripFrame& frame, const Strip& strip, double top) {
  const double zero = frame.x(0.0), middle = top + 0.5 * bar_px;
  svg.begin_group("strip " + strip.css_class, strip.name + ": " + strip.text);
  if (strip.mean) {
    const double end = frame.x(*strip.mean);
    svg.rect({std::min(zero, end), top, std::abs(end - zero), bar_px}, "bar", 1.5);
  }
  std::vector<double> places;
  for (const double value : strip.values) places.push_back(frame.x(value));
  const auto offsets = beeswarm(places, point_radius_px, 0.5 * points_px - point_radius_px);
  for (std::size_t i = 0; i < places.size(); ++i)
    svg.circle({places[i], top + bar_px + 0.5 * points_px + offsets[i]}, point_radius_px, "run");
  if (strip.interval) {
    const double lower = frame.x(strip.interval->lower), upper = frame.x(strip.interval->upper);
    svg.line({lower, middle}, {upper, middle}, "whisker");
    for (const double end : {lower, upper}) svg.line({end, middle - 4.5}, {end, middle + 4.5}, "whisker");
  }
  svg.end_group();
}

/// The row's name, and what is written of each strip.
void draw_texts(Svg& svg, const StripFrame& frame, const StripRow& row, double top) {
  const bool wide = frame.layout == FigureSize::wide, several = row.strips.size() > 1;
  const double width = width_px(frame.layout);
  if (wide) {
    const auto lines = two_lines(row.label, frame.label_px);
    for (std::size_t i = 0; i < lines.size(); ++i)
      svg.text({0, top + 10 + 15.0 * static_cast<double>(i)}, Anchor::start, "label", lines[i]);
    for (std::size_t i = 0; i < row.strips.size(); ++i) {
      const double at = top + static_cast<double>(i) * strip_px + 10;
      svg.text({width, at}, Anchor::end, "value", row.strips[i].text);
      if (several) svg.text({frame.left - 12, at}, Anchor::end, "tick", row.strips[i].name);
    }
    return;
  }
  const double label_room = several ? width : frame.label_px;
  const auto lines = two_lines(row.label, label_room);
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg.text({0, top - 6 - 15.0 * static_cast<double>(lines.size() - 1 - i)}, Anchor::start, "label",
             lines[i]);
  if (!several) {
    svg.text({width, top - 6}, Anchor::end, "value", row.strips[0].text);
    return;
  }
  for (std::size_t i = 0; i < row.strips.size(); ++i)
    svg.text({width, top + static_cast<double>(i) * strip_px + 10}, Anchor::end, "tick halo",
             row.strips[i].text);
}

}  // namespace

std::vector<double> beeswarm(const std::vector<double>& places_px, double radius_px, double most_px) {
  std::vector<std::size_t> order(places_px.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places_px[i]; });
  const double apart = 2.0 * radius_px;
  std::vector<double> offsets(places_px.size(), 0.0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto is_free = [&](double offset) {
      for (std::size_t j = k; j-- > 0 && places_px[order[k]] - places_px[order[j]] < apart;)
        if (std::hypot(places_px[order[k]] - places_px[order[j]], offset - offsets[order[j]]) < apart)
          return false;
      return true;
    };
    double chosen = (k % 2 == 0 ? 1.0 : -1.0) * most_px * static_cast<double>(k % 7) / 7.0;
    for (double step = 0.0; step <= most_px; step += 0.5)
      if (is_free(step) || is_free(-step)) {
        chosen = is_free(step) ? step : -step;
        break;
      }
    offsets[order[k]] = chosen;
  }
  return offsets;
}

std::string rows_figure(const std::vector<StripRow>& rows, std::string_view unit,
                        std::string_view description, FigureSize layout) {
  const bool wide = layout == FigureSize::wide;
  const bool several = std::ranges::any_of(rows, [](const StripRow& row) { return row.strips.size() > 1; });
  const StripFrame frame = make_strip_frame(rows, layout, several);
  const auto tops = row_tops(rows, layout);
  const double base = tops.back() - row_gap_px + 6.0;
  Svg svg(width_px(layout), base + 26, description);

  const auto ticks = figures::nice_ticks(frame.x.data, wide ? 9 : 5);
  for (const double tick : ticks.values) svg.line({frame.x(tick), 0}, {frame.x(tick), base}, "grid");
  figures::draw_x_axis(svg, frame.x, ticks, base, unit);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double top = tops[i] + label_height(rows[i], layout);
    for (std::size_t k = 0; k < rows[i].strips.size(); ++k)
      draw_strip(svg, frame, rows[i].strips[k], top + static_cast<double>(k) * strip_px);
    draw_texts(svg, frame, rows[i], top);
  }
  return svg.finish();
}

}  // namespace amble::report
