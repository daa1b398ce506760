#include "amble/io/binary.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"

namespace amble::io {

static_assert(std::endian::native == std::endian::little, "amble's files are little-endian");

void BinaryWriter::put_text(std::string_view text) {
  put(static_cast<std::uint64_t>(text.size()));
  bytes_.append(text);
}

std::string BinaryReader::get_text() {
  std::string text(get_count(1), '\0');
  copy(text.data(), text.size());
  return text;
}

std::size_t BinaryReader::get_count(std::size_t bytes_each) {
  AMBLE_CHECK(bytes_each > 0, "elements of a stored list have at least one byte");
  const auto count = get<std::uint64_t>();
  if (count > (bytes_.size() - position_) / bytes_each) bad("truncated");
  return static_cast<std::size_t>(count);
}

void BinaryReader::finish() const {
  if (position_ != bytes_.size()) bad("more bytes than expected");
}

void BinaryReader::bad(std::string_view why) const {
  fail(ExitCode::bad_file, "{}: {} at byte {}", what_, why, position_);
}

void BinaryReader::copy(void* to, std::size_t size) {
  if (size > bytes_.size() - position_) bad("truncated");
  if (size > 0) std::memcpy(to, bytes_.data() + position_, size);
  position_ += size;
}

namespace {

constexpr std::size_t magic_size = 8;

}  // namespace

std::string seal(std::string_view magic, std::uint32_t version, std::string_view payload) {
  AMBLE_CHECK(magic.size() == magic_size, "a magic has 8 characters");
  BinaryWriter header;
  header.put(version);
  header.put(static_cast<std::uint64_t>(payload.size()));
  header.put(hash_text(payload));
  std::string sealed;
  sealed.reserve(seal_header_size + payload.size());
  return sealed.append(magic).append(header.bytes()).append(payload);
}

std::uint64_t sealed_size(std::string_view magic, std::uint32_t version, std::string_view start,
                          const std::string& what) {
  AMBLE_CHECK(magic.size() == magic_size, "a magic has 8 characters");
  const std::size_t common = std::min(start.size(), magic_size);
  if (start.substr(0, common) != magic.substr(0, common)) {
    fail(ExitCode::bad_file, "{}: not a file of this kind: it does not begin with {}", what, magic);
  }
  if (start.size() < seal_header_size) {
    fail(ExitCode::bad_file, "{}: truncated: {} bytes are less than the header's {}", what, start.size(),
         seal_header_size);
  }
  BinaryReader header(start.substr(magic_size), what);
  const auto found = header.get<std::uint32_t>();
  if (found != version) {
    fail(ExitCode::bad_file, "{}: version {} of the file format; this program reads version {}", what, found,
         version);
  }
  const auto payload_size = header.get<std::uint64_t>();
  // A length near 2^64 is damage; the sum must not wrap around.
  return payload_size > UINT64_MAX - seal_header_size ? UINT64_MAX : payload_size + seal_header_size;
}

std::string_view unseal(std::string_view magic, std::uint32_t version, std::string_view bytes,
                        const std::string& what) {
  const std::uint64_t expected = sealed_size(magic, version, bytes, what);
  if (bytes.size() < expected) {
    fail(ExitCode::bad_file, "{}: truncated: {} of {} bytes", what, bytes.size(), expected);
  }
  if (bytes.size() > expected) {
    fail(ExitCode::bad_file, "{}: altered: {} bytes instead of {}", what, bytes.size(), expected);
  }
  const std::string_view payload = bytes.substr(seal_header_size);
  BinaryReader checksum(bytes.substr(seal_header_size - sizeof(std::uint64_t)), what);
  if (checksum.get<std::uint64_t>() != hash_text(payload)) {
    fail(ExitCode::bad_file, "{}: altered: its checksum does not fit", what);
  }
  return payload;
}

}  // namespace amble::io
