#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace amble::record {

// The file format of recordings, shared by writer and reader (docs/FORMATS.md):
//   a sealed header (io::seal) with magic and version below, its payload JSON;
//   chunks: u32 number of frames (not 0), u32 bytes, u64 checksum, then so many bytes of deflated frames;
//   the end: the same chunk header with 0 frames, then u64 number of all frames, u8 outcome.
inline constexpr std::string_view recording_magic = "AMBLEREC";
inline constexpr std::uint32_t recording_version = 1;
inline constexpr std::size_t frames_per_chunk = 256;
inline constexpr std::size_t column_limit = 4096;
inline constexpr std::size_t chunk_header_size = 4 + 4 + 8;
inline constexpr std::size_t end_size = 8 + 1;

/// Checksum of a chunk's bytes; covers also its place in the file and its number of frames.
std::uint64_t chunk_checksum(std::string_view bytes, std::uint32_t chunk, std::uint32_t frames);

/// Deflates whole frames of `columns` numbers each. The bytes of the numbers are sorted first: all highest
/// bytes, column by column, then the next lower ones, …, which compresses much better.
std::string compress_frames(const std::vector<float>& frames, std::size_t columns);

/// Undoes compress_frames. False if the bytes are not exactly `count` frames.
bool decompress_frames(std::string_view bytes, std::size_t count, std::size_t columns,
                       std::vector<float>& frames);

/// Upper bound of the size of a chunk's bytes.
std::size_t largest_chunk(std::size_t columns);

}  // namespace amble::record
