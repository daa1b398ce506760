#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/figures/figure_size.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::report {

/// One sample: a bar up to its mean with the mean's interval, and below the bar each value as a point.
struct Strip {
  std::string name;       ///< for tooltips; with two strips in a row, written beside the bar
  std::string css_class;  ///< carries the colour (figures::leg_class), or "base" for a grey bar
  std::vector<double> values;
  std::optional<double> mean;
  std::optional<statistics::Interval> interval;
  std::string text;  ///< the mean as displayed
};

/// A condition.
struct StripRow {
  std::string label;
  std::vector<Strip> strips;
};

/// Rows of horizontal bars over one axis that begins at zero, or lower if a value does; `unit` follows the
/// last tick label. An <svg> element.
std::string rows_figure(const std::vector<StripRow>& rows, std::string_view unit,
                        std::string_view description, figures::FigureSize layout);

/// How far points of radius `radius_px` at these positions along an axis move aside so that they do not
/// overlap: 0 at best, alternately to both sides, at most ±`most_px`, where they overlap if there is no more
/// room. One offset per position, in the order given.
std::vector<double> beeswarm(const std::vector<double>& places_px, double radius_px, double most_px);

}  // namespace amble::report
