#pragma once

#include <string_view>

namespace amble::page {

/// viewer/dist/page.html as it was when amble was built: the whole page but for title, colours and data.
std::string_view page_template();

/// viewer/dist/lab.html, the same: all but colours and robots.
std::string_view lab_template();

/// viewer/dist/amble.wasm, the same: the functions of browser/interface.hpp.
std::string_view browser_module();

}  // namespace amble::page
