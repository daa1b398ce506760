#pragma once

#include <string>
#include <string_view>

namespace amble::page {

/// A whole page of text and inline figures, as XHTML: valid both as HTML and as XML. `style` and `body` are
/// markup; the title is text. The body stands in <main>.
std::string html_page(std::string_view title, std::string_view style, std::string_view body);

}  // namespace amble::page
