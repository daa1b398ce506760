#include "amble/search/archive_log.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"

namespace amble::search {
namespace {

constexpr std::string_view magic = "AMBLEARC";
constexpr std::uint32_t version = 1;

std::string header(std::size_t length) {
  io::BinaryWriter writer;
  writer.put(version);
  writer.put(static_cast<std::uint32_t>(length));
  return std::string(magic) + writer.bytes();
}

void check_header(const std::string& found, std::size_t length, const std::string& what) {
  const std::string expected = header(length);
  const std::size_t common = std::min(found.size(), magic.size());
  if (found.substr(0, common) != magic.substr(0, common))
    fail(ExitCode::bad_file, "{}: not a file of this kind: it does not begin with {}", what, magic);
  if (found.size() < expected.size())
    fail(ExitCode::bad_file, "{}: truncated: {} bytes are less than the header's {}", what, found.size(),
         expected.size());
  io::BinaryReader reader(std::string_view(found).substr(magic.size()), what);
  const auto found_version = reader.get<std::uint32_t>();
  if (found_version != version)
    fail(ExitCode::bad_file, "{}: version {} of the file format; this program reads version {}", what,
         found_version, version);
  if (const auto found_length = reader.get<std::uint32_t>(); found_length != length)
    fail(ExitCode::bad_file, "{}: behaviours of {} numbers, this run's have {}", what, found_length, length);
}

}  // namespace

std::string ArchiveLog::take_growth(const Behaviours& archive) {
  std::string bytes = has_header_ ? "" : header(length_);
  has_header_ = true;
  for (; members_ < archive.rows(); ++members_) {
    const auto row = archive.row(members_);
    checksum_ = hash_span(row, checksum_);
    io::BinaryWriter record;
    for (const float value : row) record.put(value);
    record.put(checksum_);
    bytes += record.bytes();
  }
  return bytes;
}

void ArchiveLog::save(io::BinaryWriter& writer) const {
  writer.put(static_cast<std::uint64_t>(members_));
  writer.put(checksum_);
}

void ArchiveLog::load(io::BinaryReader& reader, std::size_t most_members) {
  const auto members = reader.get<std::uint64_t>();
  if (members > most_members) reader.bad("more archive members than the archive holds");
  members_ = static_cast<std::size_t>(members);
  checksum_ = reader.get<std::uint64_t>();
  has_header_ = true;
}

std::uint64_t ArchiveLog::restore(io::InputFile& file, const std::string& what, Behaviours& archive) const {
  AMBLE_CHECK(archive.rows() == 0 && archive.length() == length_, "restored into an empty archive");
  const std::string start = file.read(header(length_).size());
  check_header(start, length_, what);
  const std::size_t record_bytes = length_ * sizeof(float) + sizeof(std::uint64_t);
  std::uint64_t checksum = 0;
  std::vector<float> row(length_);
  for (std::size_t member = 0; member < members_; ++member) {
    const std::string record = file.read(record_bytes);
    if (record.size() < record_bytes)
      fail(ExitCode::bad_file, "{}: truncated: it has {} of {} members", what, member, members_);
    io::BinaryReader reader(record, what);
    for (float& value : row) value = reader.get<float>();
    checksum = hash_span(std::span<const float>(row), checksum);
    if (reader.get<std::uint64_t>() != checksum ||
        !std::ranges::all_of(row, [](float value) { return std::isfinite(value); }))
      fail(ExitCode::bad_file, "{}: altered: the checksum of member {} does not fit", what, member);
    archive.append(row);
  }
  if (checksum != checksum_)
    fail(ExitCode::bad_file, "{}: not the archive that the checkpoint was written with", what);
  return start.size() + members_ * record_bytes;
}

}  // namespace amble::search
