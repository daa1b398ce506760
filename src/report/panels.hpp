#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "amble/analysis/layout.hpp"
#include "amble/analysis/svg.hpp"

namespace amble::report {

/// Width of a label (13 px, semibold), estimated: pictures know no fonts.
double label_width_px(std::string_view label);
/// The label, its end replaced by "…" if it needs more room.
std::string fitted(std::string_view label, double width_px);

/// Small pictures of one size, side by side and in as many rows as they need.
struct PanelGrid {
  std::size_t columns = 1, rows = 1;
  double panel_width_px = 0.0, panel_height_px = 0.0;
  double left_px = 34.0, top_px = 24.0, below_px = 30.0, gap_px = 14.0;

  static PanelGrid of(std::size_t count, analysis::Layout layout) {
    const bool wide = layout == analysis::Layout::wide;
    PanelGrid grid;
    const std::size_t most = wide ? (count > 9 ? 4 : 3) : 2;
    grid.columns = count == 4 && wide ? 2 : std::clamp<std::size_t>(count, 1, most);
    grid.rows = (count + grid.columns - 1) / grid.columns;
    const double each = analysis::width_px(layout) / static_cast<double>(grid.columns);
    grid.panel_width_px = each - grid.left_px - grid.gap_px;
    grid.panel_height_px = std::clamp(0.6 * grid.panel_width_px, 90.0, 190.0);
    return grid;
  }
  double height_px() const { return static_cast<double>(rows) * (top_px + panel_height_px + below_px); }
  /// The plot of a panel, without its title above and its axis below.
  analysis::Box plot(std::size_t index) const {
    const double column = static_cast<double>(index % columns), row = static_cast<double>(index / columns);
    return {left_px + column * (left_px + panel_width_px + gap_px),
            top_px + row * (top_px + panel_height_px + below_px), panel_width_px, panel_height_px};
  }
};

}  // namespace amble::report
