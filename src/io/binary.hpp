#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace amble::io {

/// Appends plain values to a byte string, little-endian, without padding. Neither names nor types are stored:
/// BinaryReader takes them out in the same order by the same types.
class BinaryWriter {
 public:
  /// A number, a bool (one byte) or an enum (as its underlying type).
  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Length (64 bits), then the bytes.
  void put_text(std::string_view text);
  /// Length (64 bits), then the elements.
  template <typename T>
  requires std::is_arithmetic_v<T>
  void put_span(std::span<const T> values) {
    put(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }

  /// All that was put so far.
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what BinaryWriter wrote. Never reads beyond the end and never allocates more than the remaining
/// bytes: any mismatch throws UserError(ExitCode::bad_file) "WHAT: truncated at byte N" or the like.
class BinaryReader {
 public:
  /// `bytes` are not copied. `what` names the file in messages.
  BinaryReader(std::string_view bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  /// The next number. A bool other than 0 and 1 throws.
  template <typename T>
  requires std::is_arithmetic_v<T> T get() {
    if constexpr (std::is_same_v<T, bool>) {
      const auto raw = get<std::uint8_t>();
      if (raw > 1) bad("not a flag");
      return raw == 1;
    } else {
      T value;
      copy(&value, sizeof value);
      return value;
    }
  }
  /// An enum stored as its underlying type; `count` is the number of its values.
  template <typename T>
  requires std::is_enum_v<T> T get_enum(std::uint64_t count) {
    const auto raw = get<std::underlying_type_t<T>>();
    if (static_cast<std::uint64_t>(raw) >= count) bad("unknown enum value");
    return static_cast<T>(raw);
  }
  /// What put_text() wrote.
  std::string get_text();
  /// What put_span() wrote.
  template <typename T>
  requires std::is_arithmetic_v<T> std::vector<T> get_vector() {
    std::vector<T> values(get_count(sizeof(T)));
    copy(values.data(), values.size() * sizeof(T));
    return values;
  }
  /// A length (64 bits), for lists of what has no fixed size. Throws unless at least `bytes_each` × length
  /// bytes follow, so that nobody allocates for a length that cannot be. `bytes_each` ≥ 1.
  std::size_t get_count(std::size_t bytes_each);
  /// Throws unless all bytes were read.
  void finish() const;
  /// Throws UserError(ExitCode::bad_file) "WHAT: WHY at byte N": for values that the caller finds impossible.
  [[noreturn]] void bad(std::string_view why) const;

 private:
  void copy(void* to, std::size_t size);

  std::string_view bytes_;
  std::string what_;
  std::size_t position_ = 0;
};

/// Bytes that seal() puts before the payload: magic, version, length, checksum.
inline constexpr std::size_t seal_header_size = 8 + 4 + 8 + 8;

/// Wraps a payload for the disk: an 8-character magic, the format's version, length, checksum (XXH3, 64
/// bits), payload.
std::string seal(std::string_view magic, std::uint32_t version, std::string_view payload);
/// Checks and removes the wrapping. Throws UserError(ExitCode::bad_file): not such a file, another version,
/// truncated, or altered (checksum), each with its own message that names `what`. The result is a part of
/// `bytes`, not a copy.
std::string_view unseal(std::string_view magic, std::uint32_t version, std::string_view bytes,
                        const std::string& what);
/// Size of the whole sealed file, from its first seal_header_size bytes; throws as unseal() does. For files
/// in which more follows.
std::uint64_t sealed_size(std::string_view magic, std::uint32_t version, std::string_view start,
                          const std::string& what);

}  // namespace amble::io
