#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace amble::robot {

/// A zlib stream of the bytes. `level` is zlib's, 1 (fast) to 9 (small); what is kept in files has one and
/// the same.
std::string deflated(const std::string& bytes, int level = 6);
/// Undoes it; nothing if the stream is none, or not of exactly so many bytes.
std::optional<std::string> inflated(const std::optional<std::string>& stream, std::size_t bytes);

}  // namespace amble::robot
