#include <cmath>

#include "amble/core/check.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/record/frame_codec.hpp"
#include "amble/record/recording.hpp"

namespace amble::record {
namespace {

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
  json["origin"] = header.origin;
  return io::json_text(json);
}

}  // namespace

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
