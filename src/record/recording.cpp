#include "amble/record/recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/record/frame_codec.hpp"

namespace amble::record {
namespace {

std::string embedded_json(const io::JsonView& view) {
  if (!view.raw().is_object()) view.bad("an object");
  return view.raw().dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

RecordingHeader parse_header(std::string_view text, const std::string& what) {
  const io::Json json = io::parse_json(text, what);
  const io::JsonView view(json, what);
  RecordingHeader header;
  header.frame_s = view.at("frame_s").number();
  if (!(header.frame_s > 0.0 && header.frame_s < 1e9)) view.at("frame_s").bad("a time above 0");
  const io::JsonView columns = view.at("columns");
  if (columns.size() == 0 || columns.size() > column_limit) {
    columns.bad(fmt::format("a list of 1 to {} names", column_limit));
  }
  for (std::size_t i = 0; i < columns.size(); ++i) header.columns.push_back(columns.at(i).text());
  header.robot_json = embedded_json(view.at("robot"));
  header.controller_json = embedded_json(view.at("controller"));
  if (view.has("ground")) header.ground_json = embedded_json(view.at("ground"));
  if (view.has("damage")) header.damage_json = embedded_json(view.at("damage"));
  if (view.has("com_start_m")) {
    const io::JsonView start = view.at("com_start_m");
    if (start.size() != 3) start.bad("a list of 3 numbers");
    header.com_start_m.emplace();
    for (std::size_t i = 0; i < 3; ++i) (*header.com_start_m)[i] = start.at(i).number();
  }
  if (view.has("angle_start_rad")) {
    const io::JsonView start = view.at("angle_start_rad");
    if (start.size() > column_limit) start.bad("an angle for each joint");
    for (std::size_t i = 0; i < start.size(); ++i)
      header.angle_start_rad.push_back(static_cast<float>(start.at(i).number()));
  }
  if (view.has("mass_kg")) header.mass_kg = view.at("mass_kg").number();
  header.origin = view.at("origin").text();
  return header;
}

std::string header_json(const RecordingHeader& header) {
  AMBLE_CHECK(std::isfinite(header.frame_s) && header.frame_s > 0.0, "frames are some time apart");
  AMBLE_CHECK(!header.columns.empty() && header.columns.size() <= column_limit,
              "too few or too many columns");
  io::Json json = io::Json::object();
  json["frame_s"] = header.frame_s;
  json["columns"] = header.columns;
  json["robot"] = io::parse_json(header.robot_json, "robot of a recording");
  json["controller"] = io::parse_json(header.controller_json, "controller of a recording");
  if (!header.ground_json.empty())
    json["ground"] = io::parse_json(header.ground_json, "ground of a recording");
  if (!header.damage_json.empty())
    json["damage"] = io::parse_json(header.damage_json, "damage of a recording");
  if (header.com_start_m) json["com_start_m"] = *header.com_start_m;
  if (!header.angle_start_rad.empty()) json["angle_start_rad"] = header.angle_start_rad;
  if (header.mass_kg) json["mass_kg"] = *header.mass_kg;
  json["origin"] = header.origin;
  return io::json_text(json);
}

}  // namespace

struct RecordingReader::Impl {
  template <typename... Source>
  explicit Impl(const std::filesystem::path& path, Source&&... bytes)
      : file(std::forward<Source>(bytes)..., path), what(path.string()) {
    std::string start = file.read(io::seal_header_size);
    const std::uint64_t size = io::sealed_size(recording_magic, recording_version, start, what);
    start += file.read(size - start.size());
    header = parse_header(io::unseal(recording_magic, recording_version, start, what), what);
  }

  /// Reads the next chunk; afterwards there are frames to give, or `ended` is true.
  void read_chunk() {
    const std::string start = read_exactly(chunk_header_size);
    io::BinaryReader reader(start, what);
    const auto frame_count = reader.get<std::uint32_t>();
    const auto size = reader.get<std::uint32_t>();
    const auto checksum = reader.get<std::uint64_t>();
    const std::size_t limit = frame_count == 0 ? end_size : largest_chunk(header.columns.size());
    if (frame_count > frames_per_chunk || size > limit) altered();
    const std::string bytes = read_exactly(size);
    if (chunk_checksum(bytes, chunks, frame_count) != checksum) altered();
    if (frame_count == 0) {
      read_end(bytes);
    } else if (!decompress_frames(bytes, frame_count, header.columns.size(), frames)) {
      altered();
    }
    position = 0;
    ++chunks;
  }

  void read_end(const std::string& bytes) {
    io::BinaryReader reader(bytes, what);
    const auto total = reader.get<std::uint64_t>();
    outcome = reader.get_enum<Outcome>(outcome_names.size());
    reader.finish();
    if (total != frames_read || !file.read(1).empty()) altered();
    frames.clear();
    ended = true;
  }

  std::string read_exactly(std::size_t size) {
    std::string bytes = file.read(size);
    if (bytes.size() < size) {
      fail(ExitCode::bad_file, "{}: truncated: the recording breaks off after {} frames", what, frames_read);
    }
    return bytes;
  }

  [[noreturn]] void altered() const {
    fail(ExitCode::bad_file, "{}: altered: a checksum does not fit after {} frames", what, frames_read);
  }

  io::InputFile file;
  std::string what;
  RecordingHeader header;
  std::vector<float> frames;  ///< of the current chunk
  std::size_t position = 0;   ///< of the next number in it
  std::uint32_t chunks = 0;
  std::uint64_t frames_read = 0;
  bool ended = false;
  Outcome outcome = Outcome::completed;
};

RecordingReader::RecordingReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
RecordingReader::RecordingReader(std::string bytes, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(path, std::move(bytes))) {}
RecordingReader::~RecordingReader() = default;

const RecordingHeader& RecordingReader::header() const {
  return impl_->header;
}

int RecordingReader::column(const std::string& name) const {
  const auto& columns = impl_->header.columns;
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end())
    fail(ExitCode::bad_file, "{}: no column '{}' in the recording", impl_->what, name);
  return static_cast<int>(found - columns.begin());
}

bool RecordingReader::next(std::vector<float>& frame) {
  if (!impl_->ended && impl_->position == impl_->frames.size()) impl_->read_chunk();
  if (impl_->ended) return false;
  const auto first = impl_->frames.begin() + static_cast<std::ptrdiff_t>(impl_->position);
  const std::size_t columns = impl_->header.columns.size();
  frame.assign(first, first + static_cast<std::ptrdiff_t>(columns));
  impl_->position += columns;
  ++impl_->frames_read;
  return true;
}

Outcome RecordingReader::outcome() const {
  AMBLE_CHECK(impl_->ended, "the outcome is at the end of a recording");
  return impl_->outcome;
}

std::uint64_t RecordingReader::frames_read() const {
  return impl_->frames_read;
}

struct RecordingWriter::Impl {
  Impl(const std::filesystem::path& path, std::size_t columns_per_frame)
      : file(path), columns(columns_per_frame) {}

  void write_chunk(std::uint32_t frame_count, std::string_view bytes) {
    io::BinaryWriter header;
    header.put(frame_count);
    header.put(static_cast<std::uint32_t>(bytes.size()));
    header.put(chunk_checksum(bytes, chunks, frame_count));
    file.write(header.bytes());
    file.write(bytes);
    ++chunks;
  }

  void write_frames() {
    if (frames.empty()) return;
    write_chunk(static_cast<std::uint32_t>(frames.size() / columns), compress_frames(frames, columns));
    frames.clear();
  }

  io::AtomicFile file;
  std::size_t columns;
  std::vector<float> frames;  ///< those of the chunk that is not yet full
  std::uint32_t chunks = 0;
  std::uint64_t frames_written = 0;
};

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header) {
  const std::string json = header_json(header);
  impl_ = std::make_unique<Impl>(path, header.columns.size());
  impl_->file.write(io::seal(recording_magic, recording_version, json));
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::add(std::span<const float> frame) {
  AMBLE_CHECK(frame.size() == impl_->columns, "a frame has one number per column");
  impl_->frames.insert(impl_->frames.end(), frame.begin(), frame.end());
  ++impl_->frames_written;
  if (impl_->frames.size() == frames_per_chunk * impl_->columns) impl_->write_frames();
}

void RecordingWriter::finish(Outcome outcome) {
  impl_->write_frames();
  io::BinaryWriter end;
  end.put(impl_->frames_written);
  end.put(outcome);
  impl_->write_chunk(0, end.bytes());
  impl_->file.commit();
}

}  // namespace amble::record
