#include <cstring>
#include <vector>

#include "amble/core/hash.hpp"
#include "amble/io/binary.hpp"
#include "amble/record/frame_codec.hpp"
#include "amble/record/recording.hpp"
#include "fuzz/memory_file.hpp"
#include "fuzz/target.hpp"

namespace {

using namespace amble;

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void put_checksum(std::string& bytes, std::size_t at, std::uint64_t checksum) {
  std::memcpy(bytes.data() + at, &checksum, sizeof checksum);
}

/// Makes all checksums fit, so that the fuzzer gets at what lies behind them.
void repair_checksums(std::string& bytes) {
  if (bytes.size() < io::seal_header_size) return;
  const auto header_size = number_at<std::uint64_t>(bytes, 12);
  if (header_size > bytes.size() - io::seal_header_size) return;
  put_checksum(bytes, 20, hash_bytes(bytes.data() + io::seal_header_size, header_size));

  std::size_t at = io::seal_header_size + header_size;
  for (std::uint32_t chunk = 0; bytes.size() - at >= record::chunk_header_size; ++chunk) {
    const auto frames = number_at<std::uint32_t>(bytes, at), size = number_at<std::uint32_t>(bytes, at + 4);
    const std::size_t start = at + record::chunk_header_size;
    if (size > bytes.size() - start) return;
    const std::string_view content = std::string_view(bytes).substr(start, size);
    put_checksum(bytes, at + 8, record::chunk_checksum(content, chunk, frames));
    at = start + size;
  }
}

void read_recording(const std::string& bytes) {
  const fuzz::MemoryFile file(bytes);
  record::RecordingReader reader(file.path());
  std::vector<float> frame;
  while (reader.next(frame)) {
  }
  static_cast<void>(reader.outcome());
}

}  // namespace

AMBLE_FUZZ_TARGET(bytes) {
  try {
    read_recording(bytes);
  } catch (const UserError&) {
  }
  std::string repaired = bytes;
  repair_checksums(repaired);
  read_recording(repaired);
}
