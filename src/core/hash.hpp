#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace amble {

/// XXH3, 64 bits: for checksums of files and for naming states; not for security.
std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed = 0);
inline std::uint64_t hash_text(std::string_view text) {
  return hash_bytes(text.data(), text.size());
}

/// Hash of the bits of the elements: −0.0 and 0.0 differ, as do NaNs.
template <typename T>
requires std::is_trivially_copyable_v<T> std::uint64_t hash_span(std::span<const T> values,
                                                                 std::uint64_t seed = 0) {
  return hash_bytes(values.data(), values.size_bytes(), seed);
}

/// Sixteen lower-case hexadecimal digits.
std::string hex(std::uint64_t value);

}  // namespace amble
