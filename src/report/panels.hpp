#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "amble/figures/figure_size.hpp"
#include "amble/figures/svg.hpp"

namespace amble::report {

/// Width of a label (13 px, semibold), estimated, as SVG text cannot be measured.
double label_width_px(std::string_view label);
/// The label, its middle replaced by "…" if it needs more room.
std::string fitted(std::string_view label, double width_px);

/// The label in at most two lines; the second is fitted.
std::vector<std::string> two_lines(std::string_view label, double width_px);

/// Small pictures of one size, side by side and in as many rows as they need.
struct PanelGrid {
  std::size_t columns = 1, rows = 1;
  double panel_width_px = 0.0, panel_height_px = 0.0;
  double left_px = 42.0, top_px = 24.0, below_px = 30.0, gap_px = 14.0;

  static PanelGrid of(std::size_t count, figures::FigureSize layout) {
    const bool wide = layout == figures::FigureSize::wide;
    PanelGrid grid;
    const std::size_t most = wide ? (count > 9 ? 4 : 3) : 2;
    grid.columns = count == 4 && wide ? 2 : std::clamp<std::size_t>(count, 1, most);
    grid.rows = (count + grid.columns - 1) / grid.columns;
    const double each = figures::width_px(layout) / static_cast<double>(grid.columns);
    grid.panel_width_px = each - grid.left_px - grid.gap_px;
    grid.panel_height_px = std::clamp(0.6 * grid.panel_width_px, 90.0, 190.0);
    return grid;
  }
  /// Room for titles of two lines, if any label needs them.
  void make_room(const std::vector<std::string>& labels, double value_px) {
    const double room = panel_width_px + left_px - 8.0 - value_px;
    for (const std::string& label : labels)
      if (label_width_px(label) > room) top_px = 40.0;
  }
  double height_px() const { return static_cast<double>(rows) * (top_px + panel_height_px + below_px); }
  /// The plot of a panel, without its title above and its axis below.
  figures::Box plot(std::size_t index) const {
    const std::size_t line = index / columns;
    const double column = static_cast<double>(index % columns), row = static_cast<double>(line);
    return {left_px + column * (left_px + panel_width_px + gap_px),
            top_px + row * (top_px + panel_height_px + below_px), panel_width_px, panel_height_px};
  }
};

/// Name and value of a panel, above its plot; the name in as many as two lines.
void draw_panel_title(figures::Svg& svg, const PanelGrid& grid, const figures::Box& plot,
                      std::string_view label, std::string_view value, double value_px);

}  // namespace amble::report
