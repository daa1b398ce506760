#pragma once

#include <string>

namespace amble::analysis {

/// The style sheet of a page: light and dark, screen, phone and paper. Legs are .leg0 … .leg7, which set
/// --leg for all that they hold. The sides of a quadruped differ in hue (left blue, right orange) and its
/// ends in lightness (front dark, back light), so that they stay apart for colour-blind readers too.
std::string style_sheet();

/// The colours alone, as custom properties (--paper, --ink, --c0 …): light and dark, and light on paper.
std::string palette_style_sheet();

/// The part that figures need, for an SVG file of its own; light, or dark where the reader prefers that.
std::string figure_style_sheet();

}  // namespace amble::analysis
