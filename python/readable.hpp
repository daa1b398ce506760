#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/record/recording.hpp"
#include "python/bind.hpp"

namespace amble::python {

/// A run's folder, to read: that of one run, whatever else is made under its name later.
class ReadableRun {
 public:
  explicit ReadableRun(const std::filesystem::path& folder)
      : paths_(experiment::find_run(folder)), identity_(experiment::run_identity(paths_)) {}

  /// For messages: without a look at what is there now.
  const std::filesystem::path& folder() const { return paths_.folder; }
  /// Throws UserError(ExitCode::bad_file) if another run is there by now.
  const experiment::RunPaths& paths() const {
    experiment::find_run(paths_.folder);
    if (experiment::run_identity(paths_) != identity_)
      fail(ExitCode::bad_file, "{}: another run than when this Run was made; Run(folder) opens the new one",
           paths_.folder.string());
    return paths_;
  }

 private:
  experiment::RunPaths paths_;
  std::uint64_t identity_;
};

struct ReadableChampion {
  std::filesystem::path path;  ///< of the file that it was read from; empty: it was made here
  experiment::Champion value;

  /// What is named in recordings.
  std::string origin() const {
    return path.empty() ? fmt::format("{}, generation {}", value.experiment, value.generation)
                        : path.string();
  }
};

inline ReadableChampion champion_at(const std::filesystem::path& path) {
  const auto file = experiment::champion_at(path);
  return {file, experiment::load_champion(file)};
}

/// A whole recording in memory, as arrays and as its file had it when it was read.
struct ReadRecording {
  explicit ReadRecording(const std::filesystem::path& file) : ReadRecording(io::read_file(file), file) {}
  ReadRecording(std::string file_bytes, const std::filesystem::path& file)
      : path(file), bytes(std::move(file_bytes)) {
    auto again = reader();
    header = again.header();
    std::vector<float> frame;
    while (again.next(frame)) frames.insert(frames.end(), frame.begin(), frame.end());
    outcome = again.outcome();
  }

  record::RecordingReader reader() const { return {bytes, path}; }
  py::ssize_t width() const { return static_cast<py::ssize_t>(header.columns.size()); }
  py::ssize_t count() const { return static_cast<py::ssize_t>(frames.size()) / width(); }

  std::filesystem::path path;  ///< for messages
  std::string bytes;
  record::RecordingHeader header;
  std::vector<float> frames;
  record::Outcome outcome = record::Outcome::completed;
};

}  // namespace amble::python
