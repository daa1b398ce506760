#pragma once

#include <map>
#include <string>
#include <string_view>

namespace amble::graphics {

/// Custom properties of a style sheet, by name ("--ink"), with their values.
using CustomProperties = std::map<std::string, std::string, std::less<>>;

/// Reads declarations such as "--ink: #16191d; --mid: #8e979f;"; others are left out.
CustomProperties custom_properties(std::string_view declarations);

/// The rules that apply to an SVG element, without custom properties: var(--name) is replaced by its value,
/// var(--leg) by the colour (--c0 …) of each leg class (leg0 …) that occurs in the element. Programs that
/// know no custom properties (Inkscape, LibreOffice, librsvg) draw the result as a browser does. What differs
/// in the dark scheme follows in a media query.
/// `rules`: without at-rules; each var() that occurs must be known in both schemes.
std::string resolved_style(std::string_view rules, const CustomProperties& light,
                           const CustomProperties& dark, std::string_view element);

}  // namespace amble::graphics
