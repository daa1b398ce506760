#pragma once

#include <string_view>
#include <vector>

namespace amble::io {

/// The parts of a text between separators: one more than there are separators, so of an empty text one empty
/// part. They point into `text`.
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace amble::io
