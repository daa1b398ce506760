#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "amble/experiment/run.hpp"

namespace amble::cli {

/// Shows the progress of a run on stderr: on a terminal one line that is rewritten, and as short as the
/// terminal is wide; else a plain line from time to time. The first is there before the first generation
/// ends.
class ProgressLine : public experiment::RunListener {
 public:
  ProgressLine(int first_generation, const experiment::Config& config);
  ~ProgressLine() override;
  void on_generation(const experiment::GenerationRow& row, const experiment::Progress& progress,
                     const experiment::Config& config) override;

 private:
  /// The parts of a line, the most important first.
  void show(const std::vector<std::string>& parts);

  bool terminal_;
  bool open_ = false;  ///< a rewritten line has no newline yet
  int first_generation_;
  double start_s_;
  double last_print_s_ = 0.0;
};

/// Shows on stderr how many of a number of equal parts are done, and how long the rest takes; nothing if all
/// take less than some seconds.
class PartsLine {
 public:
  explicit PartsLine(std::string what);  ///< "trials"
  ~PartsLine();
  PartsLine(const PartsLine&) = delete;
  PartsLine& operator=(const PartsLine&) = delete;
  void show(std::size_t done, std::size_t of);

 private:
  std::string what_;
  bool terminal_;
  bool open_ = false;  ///< a rewritten line has no newline yet
  double start_s_, last_print_s_;
};

/// "0:07", "12:30", "3:05:00".
std::string clock_text(double seconds);

}  // namespace amble::cli
