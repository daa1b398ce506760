#pragma once

#include <filesystem>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/record/recording.hpp"
#include "python/bind.hpp"

namespace amble::python {

/// A run's folder, to read.
struct ReadableRun {
  explicit ReadableRun(const std::filesystem::path& folder) : paths(experiment::find_run(folder)) {}
  experiment::RunPaths paths;
};

struct ReadableChampion {
  std::filesystem::path path;
  experiment::Champion value;
};

inline ReadableChampion champion_at(const std::filesystem::path& path) {
  const auto file = experiment::champion_at(path);
  return {file, experiment::load_champion(file)};
}

/// A whole recording in memory.
struct ReadRecording {
  explicit ReadRecording(const std::filesystem::path& file) : path(file) {
    record::RecordingReader reader(file);
    header = reader.header();
    std::vector<float> frame;
    while (reader.next(frame)) frames.insert(frames.end(), frame.begin(), frame.end());
    outcome = reader.outcome();
  }

  py::ssize_t width() const { return static_cast<py::ssize_t>(header.columns.size()); }
  py::ssize_t count() const { return static_cast<py::ssize_t>(frames.size()) / width(); }

  std::filesystem::path path;
  record::RecordingHeader header;
  std::vector<float> frames;
  record::Outcome outcome = record::Outcome::completed;
};

}  // namespace amble::python
