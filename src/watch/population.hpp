#pragma once

#include <memory>
#include <string>

#include "amble/experiment/run_folder.hpp"
#include "amble/io/json_file.hpp"
#include "amble/watch/table_tail.hpp"

namespace amble::watch {

/// What a run's checkpoint and archive have of its population: the sizes of its species, its map. The table
/// has neither. Reading takes longer than all else, so it is done at most every two seconds, and as seldom as
/// keeps it below 1/500 of the time.
class PopulationReader {
 public:
  explicit PopulationReader(const experiment::RunPaths& paths);
  ~PopulationReader();

  /// What has come since the last call, or null: {"generation": N, "species": [[id, size], …]}, the
  /// population that generation N is; of a run under MAP-Elites {"map": {"axes": [{"name", "least", "most",
  /// "bins"}, …] of a grid with at most 20,000 elites, else empty, "cells": N, "count": N of them that are
  /// filled, "filled": [[cell, objective], …] where there are axes}}. Files that are being replaced or do not
  /// fit give nothing.
  io::Json poll(double now_s);

 private:
  struct Run;
  io::Json read();
  io::Json species();
  io::Json map();

  experiment::RunPaths paths_;
  FileMark config_, read_;
  std::unique_ptr<Run> run_;
  double due_s_ = 0.0;
};

}  // namespace amble::watch
