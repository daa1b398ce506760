#pragma once

#include <string>

namespace amble::analysis {

/// The style sheet of a page: light and dark, screen, phone and paper. Legs are .leg0 … .leg7, which set
/// --leg for all that they hold. The sides of a quadruped differ in hue (left blue, right orange) and its
/// ends in lightness (front dark, back light), so that they stay apart for colour-blind readers too.
std::string style_sheet();

/// For pages with a style of their own: the colours, as custom properties (--paper, --ink, --c0 …), light and
/// dark, and light on paper; and how a CPPN is drawn (cppn_figure.hpp).
std::string shared_style_sheet();

/// An <svg> element (svg.hpp) as a file of its own, with the part of the style sheet that figures need:
/// light, or dark where the reader prefers that.
std::string standalone_svg(std::string element);

}  // namespace amble::analysis
