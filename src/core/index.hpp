#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace amble {

/// A signed number that is not negative, or an enumerator, as an index into (or the size of) a standard
/// container. Indices of bodies, joints, nodes and so on are `int`, with −1 for "none".
template <typename T>
requires(std::signed_integral<T> || std::is_enum_v<T>) constexpr std::size_t to_index(T value) {
  return static_cast<std::size_t>(value);
}

}  // namespace amble
