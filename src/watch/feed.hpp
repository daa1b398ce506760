#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "amble/experiment/run_folder.hpp"
#include "amble/watch/population.hpp"
#include "amble/watch/table_tail.hpp"

namespace amble::watch {

/// All that pages are told of one run: its table line by line, and its population. For those that look at it.
class Feed {
 public:
  explicit Feed(const experiment::RunPaths& paths) : table_(paths.generations), population_(paths) {}

  /// Whether something has come.
  bool poll(double now_s);

  /// How often the table has begun; its lines so far, without their ends; the first is the header.
  int beginning() const { return beginning_; }
  const std::vector<std::string>& lines() const { return lines_; }
  /// The latest of PopulationReader::poll as text; how many there have been.
  const std::string& population() const { return population_text_; }
  int populations() const { return populations_; }

 private:
  TableTail table_;
  PopulationReader population_;
  std::vector<std::string> lines_;
  std::string population_text_;
  int beginning_ = 0, populations_ = 0;
};

}  // namespace amble::watch
