#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` with control characters written as \xNN, so that a message that quotes it stays one line.
std::string printable(std::string_view text);

}  // namespace amble::io
