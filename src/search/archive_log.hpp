#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/search/behaviours.hpp"

namespace amble::search {

/// Persists an archive in an append-only file, to which each generation appends its new members
/// (docs/FORMATS.md). Every member is followed by a checksum over all members so far, and the checkpoint
/// contains the last of these: it stays small, and still fits this archive only.
class ArchiveLog {
 public:
  explicit ArchiveLog(std::size_t length) : length_(length) {}

  /// Bytes to append to the file for the members added since the last call; initially with the header.
  std::string take_growth(const Behaviours& archive);

  /// Number of members and checksum; restore() reads that part of the file.
  void save(io::BinaryWriter& writer) const;
  void load(io::BinaryReader& reader, std::size_t most_members);
  /// Fills the empty `archive` from the file, and returns the length of the part that was read; anything
  /// after it is ignored. Throws UserError(bad_file) "WHAT: …": foreign, truncated, altered.
  std::uint64_t restore(io::InputFile& file, const std::string& what, Behaviours& archive) const;

  std::size_t members() const { return members_; }

 private:
  std::size_t length_;
  bool has_header_ = false;
  std::size_t members_ = 0;     ///< in the file
  std::uint64_t checksum_ = 0;  ///< over all of them
};

}  // namespace amble::search
