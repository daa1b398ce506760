#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/search/behaviours.hpp"

namespace amble::search {

/// An archive's way to the disk: a file that only grows, to which each generation appends its new members
/// (docs/FORMATS.md). Every member is followed by a checksum over all members so far, and the last of these
/// stands in the checkpoint: so the checkpoint stays small, and still only goes with this very archive.
class ArchiveLog {
 public:
  explicit ArchiveLog(std::size_t length) : length_(length) {}

  /// Bytes to append to the file for what joined the archive since the last call; the first ones are the
  /// header.
  std::string take_growth(const Behaviours& archive);

  /// How far the file had come; restore() then reads so much of it.
  void save(io::BinaryWriter& writer) const;
  void load(io::BinaryReader& reader, std::size_t most_members);
  /// Fills the empty `archive` from the file, and returns how many of its bytes count. What lies beyond is
  /// not read. Throws UserError(bad_file) "WHAT: …": foreign, truncated, altered.
  std::uint64_t restore(io::InputFile& file, const std::string& what, Behaviours& archive) const;

  std::size_t members() const { return members_; }

 private:
  std::size_t length_;
  bool has_header_ = false;
  std::size_t members_ = 0;     ///< in the file
  std::uint64_t checksum_ = 0;  ///< over all of them
};

}  // namespace amble::search
