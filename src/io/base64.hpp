#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace amble::io {

/// Bytes as text (RFC 4648, sec. 4, with padding).
std::string base64(std::string_view bytes);
/// The reverse; nothing for what base64() does not write.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace amble::io
