#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace amble::morphology {

/// How a part of a model file was handled.
enum class Reading {
  kept,      ///< read as it is
  replaced,  ///< by something that amble can simulate
  left_out,  ///< without effect on the robot, or not simulated
};

/// What was read from a model and what was not, a line with its reason each.
class ReadingNotes {
 public:
  struct Line {
    Reading reading;
    std::string text;
    bool is_doubt = false;  ///< also a warning: the file hardly means what it says
  };

  /// The same line is kept once.
  void add(Reading reading, std::string text, bool is_doubt = false);
  void add(const ReadingNotes& others);

  const std::vector<Line>& lines() const { return lines_; }
  /// Lines "  kept      …", grouped by how they were handled; empty if there are none.
  std::string text() const;

 private:
  std::vector<Line> lines_;
};

}  // namespace amble::morphology
