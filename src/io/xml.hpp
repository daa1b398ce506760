#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` for the content or an attribute's value of an XML, SVG or HTML element: <, >, &, " and ' become
/// entities; control characters, which XML forbids, become U+FFFD. Tabs and line feeds stay.
std::string escape_xml(std::string_view text);

}  // namespace amble::io
