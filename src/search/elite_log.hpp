#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/search/elites.hpp"

namespace amble::search {

/// Changes a map and keeps a log of it: an append-only file, from which the map is read back
/// (docs/FORMATS.md). Every record is followed by a checksum over all records so far, and the checkpoint
/// contains the last of these: it stays small, and still fits this map only.
class LoggedElites {
 public:
  /// `has_spread`: whether Elite::spread is in the file.
  LoggedElites(std::uint32_t cells, std::size_t dimensions, bool has_spread = false)
      : elites_(cells, dimensions), has_spread_(has_spread) {}

  const Elites& elites() const { return elites_; }

  /// As those of Elites, and logged.
  void put(Elite elite, std::span<const float> descriptor);
  void update(const Elite& elite, std::span<const float> descriptor);
  void remove(std::uint32_t cell);

  /// Bytes to append to the file for the changes since the last call; initially with the header.
  std::string take_growth();

  /// Number of records, their bytes and checksum; restore() reads that part of the file.
  void save(io::BinaryWriter& writer) const;
  void load(io::BinaryReader& reader);
  /// Fills the empty map from the file, and returns the length of the part that was read; anything after it
  /// is ignored. Throws UserError(bad_file) "WHAT: …": foreign, truncated, altered.
  std::uint64_t restore(io::InputFile& file, const std::string& what);

 private:
  void log(std::string record);

  Elites elites_;
  bool has_spread_;
  bool has_header_ = false;
  std::string growth_;
  std::uint64_t records_ = 0, bytes_ = 0;
  std::uint64_t checksum_ = 0;  ///< over all records
};

/// The map in an archive file, whatever its run: as many records as are whole. Throws UserError(bad_file).
Elites read_elites(io::InputFile& file, const std::string& what, std::uint32_t cells, std::size_t dimensions);

}  // namespace amble::search
