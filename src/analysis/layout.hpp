#pragma once

#include <string>

namespace amble::analysis {

/// Every figure is drawn twice, for wide windows and paper and for a phone; the page shows the one that fits.
enum class Layout { wide, narrow };

/// Width of a figure. One px is one CSS px when nothing is scaled, so text has the same size in both layouts.
constexpr double width_px(Layout layout) {
  return layout == Layout::wide ? 960.0 : 352.0;
}

/// Colours of legs are told apart up to this many.
inline constexpr int leg_colours = 8;

/// The CSS class that carries the colour of a leg.
inline std::string leg_class(int leg) {
  return "leg" + std::to_string(leg % leg_colours);
}

}  // namespace amble::analysis
