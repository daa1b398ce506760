#pragma once

#include <string>
#include <string_view>

namespace amble::view {

/// Bytes as text (RFC 4648, sec. 4, with padding).
std::string base64(std::string_view bytes);

}  // namespace amble::view
