#pragma once

#include <string>

#include "amble/experiment/run.hpp"

namespace amble::cli {

/// Tells how a run goes: on a terminal one line that rewrites itself, else a plain line now and then. To
/// stderr.
class ProgressLine : public experiment::RunListener {
 public:
  explicit ProgressLine(int first_generation);
  ~ProgressLine() override;
  void on_generation(const experiment::GenerationRow& row, const experiment::Progress& progress,
                     const experiment::Config& config) override;

 private:
  bool terminal_;
  bool open_ = false;  ///< a rewritten line stands without its end
  int first_generation_;
  double start_s_;
  double last_print_s_ = 0.0;
};

/// "0:07", "12:30", "3:05:00".
std::string clock_text(double seconds);

}  // namespace amble::cli
