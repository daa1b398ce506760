#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/ledger/record.hpp"
#include "amble/study/plan.hpp"

namespace amble::study {

/// Receives the progress of a study. Called from the thread of work().
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void on_start(const PlannedRun& run, int generations_done) = 0;
  virtual void on_generation(const PlannedRun& run, int generations_done) = 0;
  virtual void on_finish(const PlannedRun& run, const ledger::Record& record) = 0;
  virtual void on_failure(const PlannedRun& run, const std::string& reason) = 0;
};

struct WorkOptions {
  Shard shard;
  int workers = 1;            ///< of each run
  bool discard_runs = false;  ///< removes a run's folder once its record is written
};

struct WorkResult {
  int finished = 0;   ///< by this call
  int failed = 0;     ///< reported to the listener; the others continued
  int elsewhere = 0;  ///< locked by other processes when this one had nothing else to do
  bool interrupted = false;
  ExitCode first_failure = ExitCode::ok;
};

/// Does the unfinished runs of a shard, one after another: evolution, tests, record. Runs whose folders are
/// locked are left to the process that locked them, so several processes may work on one study. A run that
/// fails does not stop the others, unless the disk refuses files of several runs in a row. Ends early, with
/// resumable run folders, if `stop` is set. `states` are those of survey().
WorkResult work(const Plan& plan, const std::vector<RunStatus>& states, const WorkOptions& options,
                Listener& listener, const std::atomic<bool>& stop);

}  // namespace amble::study
