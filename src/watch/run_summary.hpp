#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/experiment/run_folder.hpp"
#include "amble/io/json_file.hpp"
#include "amble/watch/lock_holders.hpp"
#include "amble/watch/table_tail.hpp"

namespace amble::watch {

/// What a run is doing, as far as its files tell.
enum class Stage {
  waiting,  ///< its folder is no run yet
  running,
  stopped,  ///< generations are left, and nobody works on them
  ended,    ///< all generations are done
  gone      ///< its folder was there, and is not any more
};

/// What is said of a run in a line: how far it is, how good, how long it will take.
struct Summary {
  std::string id;  ///< its folder, relative to the one that is watched; "." for that itself
  Stage stage = Stage::waiting;
  std::string name, search, unit;  ///< of its config: experiment, kind of search; of the objective, e.g. "m"
  std::int64_t seed = 0;
  int generations = 0;  ///< in all; 0: not known
  int done = 0;
  std::optional<double> best, typical, median;  ///< best_so_far, typical and median of generations.csv
  std::optional<double> left_s;                 ///< of a run that goes on, by its latest generations
  std::optional<int> champion;                  ///< generation of its latest champion's file
  std::string trouble;                          ///< a file that cannot be read, and why; empty: none

  io::Json json() const;
  bool operator==(const Summary&) const = default;
};

/// Keeps a run's summary up to date, from the end of its table; what has not changed is not read again.
class SummaryReader {
 public:
  SummaryReader(const std::filesystem::path& folder, std::string id);

  /// Whether the summary has changed. `now_s`: now_s(). A run that waits, or is gone, may begin again.
  bool poll(const LockHolders& locks, double now_s);
  const Summary& summary() const { return summary_; }
  const experiment::RunPaths& paths() const { return paths_; }

 private:
  void read_config();
  void read_table();
  Stage stage(const LockHolders& locks, double now_s) const;

  experiment::RunPaths paths_;
  Summary summary_;
  FileMark config_, table_;
  double grew_s_ = -1e9;       ///< when its table was last seen to grow
  double generation_s_ = 0.0;  ///< wall time of its latest generations, mean
};

}  // namespace amble::watch
