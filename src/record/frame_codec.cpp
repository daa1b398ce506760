#include "amble/record/frame_codec.hpp"

#include <zlib.h>

#include <bit>

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"

namespace amble::record {
namespace {

constexpr std::size_t number_size = sizeof(float);

/// Position among the sorted bytes of byte `byte` (0: the lowest) of a number.
std::size_t sorted_position(std::size_t byte, std::size_t column, std::size_t frame, std::size_t columns,
                            std::size_t frames) {
  return ((number_size - 1 - byte) * columns + column) * frames + frame;
}

}  // namespace

std::uint64_t chunk_checksum(std::string_view bytes, std::uint32_t chunk, std::uint32_t frames) {
  return hash_bytes(bytes.data(), bytes.size(), std::uint64_t{chunk} << 32 | frames);
}

std::size_t largest_chunk(std::size_t columns) {
  return compressBound(static_cast<uLong>(frames_per_chunk * columns * number_size));
}

std::string compress_frames(const std::vector<float>& frames, std::size_t columns) {
  const std::size_t count = frames.size() / columns;
  std::string sorted(frames.size() * number_size, '\0');
  for (std::size_t frame = 0; frame < count; ++frame) {
    for (std::size_t column = 0; column < columns; ++column) {
      const auto bits = std::bit_cast<std::uint32_t>(frames[frame * columns + column]);
      for (std::size_t byte = 0; byte < number_size; ++byte) {
        sorted[sorted_position(byte, column, frame, columns, count)] =
            static_cast<char>(bits >> (8 * byte) & 0xff);
      }
    }
  }

  std::string bytes(compressBound(static_cast<uLong>(sorted.size())), '\0');
  auto size = static_cast<uLongf>(bytes.size());
  const int status =
      compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(sorted.data()),
                static_cast<uLong>(sorted.size()), 6);
  AMBLE_CHECK(status == Z_OK, "deflating into a large enough buffer");
  bytes.resize(size);
  return bytes;
}

bool decompress_frames(std::string_view bytes, std::size_t count, std::size_t columns,
                       std::vector<float>& frames) {
  std::string sorted(count * columns * number_size, '\0');
  auto size = static_cast<uLongf>(sorted.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(sorted.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uLong>(bytes.size()));
  if (status != Z_OK || size != sorted.size()) return false;

  frames.resize(count * columns);
  for (std::size_t frame = 0; frame < count; ++frame) {
    for (std::size_t column = 0; column < columns; ++column) {
      std::uint32_t bits = 0;
      for (std::size_t byte = 0; byte < number_size; ++byte) {
        const auto value =
            static_cast<unsigned char>(sorted[sorted_position(byte, column, frame, columns, count)]);
        bits |= std::uint32_t{value} << (8 * byte);
      }
      frames[frame * columns + column] = std::bit_cast<float>(bits);
    }
  }
  return true;
}

}  // namespace amble::record
