#pragma once

#include <string>
#include <string_view>

namespace amble::figures {

/// The style sheet of a page: light and dark, screen, phone and paper. Legs are .leg0 … .leg7, which set
/// --leg for the elements inside, and in figures the current colour. The sides of a quadruped differ in hue
/// (left blue, right orange), front and back in lightness (front dark, back light), so that colour-blind
/// readers can tell them apart too.
std::string style_sheet();

/// For pages with a style of their own: the colours as custom properties (--paper, --ink, --c0 …), light and
/// dark, and light on paper; and the style of CPPNs (figures/cppn_figure.hpp).
std::string shared_style_sheet();

/// For such pages: the style of plots and of maps of elites (figures/map_figure.hpp).
std::string map_style_sheet();

/// An <svg> element (svg.hpp) as a file of its own with the rules for its classes, and those of `more_rules`
/// (for classes that this folder does not know; whole rules, a line each): light, or dark if the viewer
/// prefers that, with colours in place of custom properties, which programs other than browsers do not know.
std::string standalone_svg(std::string element, std::string_view more_rules = {});

/// A file by standalone_svg() with more rules behind its own, as they are: such as animations.
std::string with_rules(std::string svg, std::string_view rules);

}  // namespace amble::figures
