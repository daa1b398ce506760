#include "amble/search/elite_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"

namespace amble::search {
namespace {

constexpr std::string_view map_magic = "AMBLEMAP";
constexpr std::uint32_t plain_version = 1, spread_version = 2;
constexpr std::size_t header_bytes = 8 + 4 + 4 + 4;
constexpr std::uint32_t longest_record = 100'000'000;

enum class Change : std::uint8_t { put = 0, update = 1, remove = 2 };
constexpr std::uint64_t changes = 3;

std::string map_header(std::uint32_t cells, std::size_t dimensions, bool has_spread) {
  io::BinaryWriter writer;
  writer.put(has_spread ? spread_version : plain_version);
  writer.put(cells);
  writer.put(static_cast<std::uint32_t>(dimensions));
  return std::string(map_magic) + writer.bytes();
}

/// Whether the file has spreads. Throws UserError for a file that is not of this map.
bool read_map_header(const std::string& found, std::uint32_t cells, std::size_t dimensions,
                     const std::string& what) {
  const std::size_t common = std::min(found.size(), map_magic.size());
  if (found.substr(0, common) != map_magic.substr(0, common))
    fail(ExitCode::bad_file, "{}: not a file of this kind: it does not begin with {}", what, map_magic);
  if (found.size() < header_bytes)
    fail(ExitCode::bad_file, "{}: truncated: {} bytes are less than the header's {}", what, found.size(),
         header_bytes);
  io::BinaryReader reader(std::string_view(found).substr(map_magic.size()), what);
  const auto its_version = reader.get<std::uint32_t>();
  if (its_version != plain_version && its_version != spread_version)
    fail(ExitCode::bad_file, "{}: version {} of the file format; this program reads versions {} and {}", what,
         its_version, plain_version, spread_version);
  const auto its_cells = reader.get<std::uint32_t>(), its_dimensions = reader.get<std::uint32_t>();
  if (its_cells != cells || its_dimensions != dimensions)
    fail(ExitCode::bad_file, "{}: a map of {} cells in {} dimensions, this run's has {} in {}", what,
         its_cells, its_dimensions, cells, dimensions);
  return its_version == spread_version;
}

void put_descriptor(io::BinaryWriter& writer, std::span<const float> descriptor) {
  for (const float value : descriptor) writer.put(value);
}

/// A record: its length, its bytes, the checksum. Empty at the end of the file or where it is cut off.
std::string read_record(io::InputFile& file, std::uint64_t& checksum, const std::string& what, bool& whole) {
  const std::string length_bytes = file.read(sizeof(std::uint32_t));
  whole = false;
  if (length_bytes.size() < sizeof(std::uint32_t)) return {};
  const auto length = io::BinaryReader(length_bytes, what).get<std::uint32_t>();
  if (length > longest_record) fail(ExitCode::bad_file, "{}: altered: a record of {} bytes", what, length);
  std::string record = file.read(length + sizeof(std::uint64_t));
  if (record.size() < length + sizeof(std::uint64_t)) return {};
  const auto its_checksum =
      io::BinaryReader(std::string_view(record).substr(length), what).get<std::uint64_t>();
  record.resize(length);
  checksum = hash_bytes(record.data(), record.size(), checksum);
  if (its_checksum != checksum)
    fail(ExitCode::bad_file, "{}: altered: the checksum of a record does not fit", what);
  whole = true;
  return record;
}

std::vector<float> get_descriptor(io::BinaryReader& reader, std::size_t dimensions) {
  std::vector<float> descriptor(dimensions);
  for (float& value : descriptor) {
    value = reader.get<float>();
    if (!std::isfinite(value)) reader.bad("a descriptor is not finite");
  }
  return descriptor;
}

/// Applies a record to a map.
void apply(io::BinaryReader& reader, bool has_spread, Elites& elites) {
  const auto change = reader.get_enum<Change>(changes);
  Elite elite;
  elite.cell = reader.get<std::uint32_t>();
  if (elite.cell >= elites.cells()) reader.bad("a cell that the map does not have");
  if (change != Change::put && elites.in(elite.cell) == Elites::none) reader.bad("a change of an empty cell");
  if (change == Change::remove) {
    elites.remove(elite.cell);
  } else {
    elite.evaluations = reader.get<std::uint32_t>();
    elite.objective = reader.get<double>();
    if (!std::isfinite(elite.objective)) reader.bad("an objective is not finite");
    if (has_spread) elite.spread = reader.get<double>();
    if (!(elite.spread >= 0.0 && std::isfinite(elite.spread))) reader.bad("a spread below 0");
    const auto descriptor = get_descriptor(reader, elites.dimensions());
    if (change == Change::update) {
      elites.update(elite, descriptor);
    } else {
      elite.round = reader.get<std::uint32_t>();
      elite.candidate = reader.get<std::uint32_t>();
      elite.genome = reader.get_text();
      elites.put(std::move(elite), descriptor);
    }
  }
  reader.finish();
}

}  // namespace

void LoggedElites::log(std::string record) {
  io::BinaryWriter start, end;
  start.put(static_cast<std::uint32_t>(record.size()));
  checksum_ = hash_bytes(record.data(), record.size(), checksum_);
  end.put(checksum_);
  growth_ += start.bytes() + record + end.bytes();
  ++records_;
}

void LoggedElites::put(Elite elite, std::span<const float> descriptor) {
  io::BinaryWriter record;
  record.put(Change::put);
  record.put(elite.cell);
  record.put(elite.evaluations);
  record.put(elite.objective);
  if (has_spread_) record.put(elite.spread);
  put_descriptor(record, descriptor);
  record.put(elite.round);
  record.put(elite.candidate);
  record.put_text(elite.genome);
  log(record.bytes());
  elites_.put(std::move(elite), descriptor);
}

void LoggedElites::update(const Elite& elite, std::span<const float> descriptor) {
  io::BinaryWriter record;
  record.put(Change::update);
  record.put(elite.cell);
  record.put(elite.evaluations);
  record.put(elite.objective);
  if (has_spread_) record.put(elite.spread);
  put_descriptor(record, descriptor);
  log(record.bytes());
  elites_.update(elite, descriptor);
}

void LoggedElites::remove(std::uint32_t cell) {
  io::BinaryWriter record;
  record.put(Change::remove);
  record.put(cell);
  log(record.bytes());
  elites_.remove(cell);
}

std::string LoggedElites::take_growth() {
  if (!std::exchange(has_header_, true))
    growth_.insert(0, map_header(elites_.cells(), elites_.dimensions(), has_spread_));
  bytes_ += growth_.size();
  return std::exchange(growth_, {});
}

void LoggedElites::save(io::BinaryWriter& writer) const {
  AMBLE_CHECK(growth_.empty(), "the log's growth is taken before a checkpoint");
  writer.put(records_);
  writer.put(bytes_);
  writer.put(checksum_);
}

void LoggedElites::load(io::BinaryReader& reader) {
  records_ = reader.get<std::uint64_t>();
  bytes_ = reader.get<std::uint64_t>();
  checksum_ = reader.get<std::uint64_t>();
  has_header_ = true;
  growth_.clear();
}

std::uint64_t LoggedElites::restore(io::InputFile& file, const std::string& what) {
  AMBLE_CHECK(elites_.size() == 0, "restored into an empty map");
  if (read_map_header(file.read(header_bytes), elites_.cells(), elites_.dimensions(), what) != has_spread_)
    fail(ExitCode::bad_file, "{}: a map of other settings of search.map_elites.trials", what);
  std::uint64_t checksum = 0;
  for (std::uint64_t i = 0; i < records_; ++i) {
    bool whole = false;
    const std::string record = read_record(file, checksum, what, whole);
    if (!whole) fail(ExitCode::bad_file, "{}: truncated: it has {} of {} records", what, i, records_);
    io::BinaryReader reader(record, what);
    apply(reader, has_spread_, elites_);
  }
  if (checksum != checksum_)
    fail(ExitCode::bad_file, "{}: not the archive that the checkpoint was written with", what);
  return bytes_;
}

Elites read_elites(io::InputFile& file, const std::string& what, std::uint32_t cells,
                   std::size_t dimensions) {
  const bool has_spread = read_map_header(file.read(header_bytes), cells, dimensions, what);
  Elites elites(cells, dimensions);
  std::uint64_t checksum = 0;
  for (bool whole = true; whole;) {
    const std::string record = read_record(file, checksum, what, whole);
    if (!whole) break;
    io::BinaryReader reader(record, what);
    apply(reader, has_spread, elites);
  }
  return elites;
}

}  // namespace amble::search
