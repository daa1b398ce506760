#pragma once

#include <string>
#include <string_view>

namespace amble::page {

/// A whole page of text and inline figures, as XHTML: valid both as HTML and as XML. `style` and `body` are
/// markup; the title is text. The body stands in <main>.
std::string html_page(std::string_view title, std::string_view style, std::string_view body);

/// viewer/dist/page.html as it was when amble was built: the whole page but for title, colours and data.
std::string_view page_template();

/// viewer/dist/lab.html, the same: all but colours and robots.
std::string_view lab_template();

/// viewer/dist/watch.html, the same: all but colours.
std::string_view watch_template();

/// viewer/dist/amble.wasm, the same: the functions of browser/interface.hpp.
std::string_view browser_module();

/// viewer/dist/amble-relaxed.patch, the same: makes of that module one with WebAssembly's relaxed SIMD
/// (viewer/src/patch.js).
std::string_view relaxed_patch();

}  // namespace amble::page
