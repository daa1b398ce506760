#include "amble/record/frame_codec.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "amble/core/random.hpp"

namespace amble::record {
namespace {

std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

TEST(FrameCodec, KeepsEveryBitOfRandomFrames) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    const std::size_t columns = 1 + stream.below(20), count = 1 + stream.below(frames_per_chunk);
    std::vector<float> frames(columns * count), read;
    for (float& value : frames) value = std::bit_cast<float>(stream.next_u32());
    const std::string bytes = compress_frames(frames, columns);
    EXPECT_LE(bytes.size(), largest_chunk(columns));
    ASSERT_TRUE(decompress_frames(bytes, count, columns, read));
    ASSERT_EQ(bits_of(read), bits_of(frames));
  }
}

TEST(FrameCodec, RefusesBytesOfAnotherSize) {
  const std::vector<float> frames(12, 1.0f);
  const std::string bytes = compress_frames(frames, 3);
  std::vector<float> read;
  EXPECT_TRUE(decompress_frames(bytes, 4, 3, read));
  EXPECT_FALSE(decompress_frames(bytes, 3, 3, read));
  EXPECT_FALSE(decompress_frames(bytes, 5, 3, read));
  EXPECT_FALSE(decompress_frames(bytes.substr(0, bytes.size() - 1), 4, 3, read));
  EXPECT_FALSE(decompress_frames("", 4, 3, read));
}

TEST(FrameCodec, MakesSmoothMotionMuchSmaller) {
  // A body that walks: 24 angles that oscillate and a position that advances, at 100 Hz.
  constexpr std::size_t columns = 25;
  std::vector<float> frames;
  for (std::size_t i = 0; i < frames_per_chunk; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      frames.push_back(static_cast<float>(std::sin(6.28 * t + static_cast<double>(j))));
    }
    frames.push_back(static_cast<float>(0.2 * t));
  }
  EXPECT_LT(compress_frames(frames, columns).size(), frames.size() * sizeof(float) * 7 / 10);
}

TEST(ChunkChecksum, CoversPlaceAndNumberOfFrames) {
  const auto base = chunk_checksum("bytes", 1, 256);
  EXPECT_EQ(base, chunk_checksum("bytes", 1, 256));
  EXPECT_NE(base, chunk_checksum("bytes", 2, 256));
  EXPECT_NE(base, chunk_checksum("bytes", 1, 255));
  EXPECT_NE(base, chunk_checksum("bytez", 1, 256));
}

}  // namespace
}  // namespace amble::record
