#pragma once

#include <string>
#include <string_view>

#include "amble/io/json_file.hpp"

namespace amble::page {

/// JSON for the content of a <script> element: pure ASCII and without "<", which occurs in strings only.
std::string script_text(const io::Json& json);

/// Bytes as text for a page: deflated, base64.
std::string packed(const std::string& bytes);

/// The elements that have the WebAssembly module, and what makes of it the one with relaxed SIMD.
std::string module_elements();

/// Appends the end of a template, from after its last mark: the page's program is packed, and is unpacked and
/// started by the script that stands after it (viewer/src/unpack.js).
void fill_end(std::string_view rest, std::string& page);

/// Appends the template up to a mark, then `content` instead of the mark; returns the rest.
std::string_view fill(std::string_view rest, std::string_view mark, std::string_view content,
                      std::string& page);

}  // namespace amble::page
