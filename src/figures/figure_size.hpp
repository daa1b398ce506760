#pragma once

#include <string>

namespace amble::figures {

/// Every figure is drawn twice, for wide windows and paper and for phones; the page shows the one that fits.
enum class FigureSize { wide, narrow };

/// Width of a figure. One px is one CSS px when nothing is scaled, so text has the same size in both layouts.
constexpr double width_px(FigureSize layout) {
  return layout == FigureSize::wide ? 960.0 : 352.0;
}

/// Number of distinct colours of legs.
inline constexpr int leg_colours = 8;

/// The CSS class that carries the colour of a leg.
inline std::string leg_class(int leg) {
  return "leg" + std::to_string(leg % leg_colours);
}

}  // namespace amble::figures
