#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "amble/study/plan.hpp"
#include "amble/study/time_left.hpp"
#include "amble/study/worker.hpp"

namespace amble::cli {

/// An event of a process that works on a study: one line of text each, which its parent reads from a pipe.
struct StudyEvent {
  enum class Kind { start, generation, finish, failure };
  Kind kind = Kind::start;
  std::size_t run = 0;          ///< index in Plan::runs
  int generations = 0;          ///< done of this run
  double best_objective = 0.0;  ///< of a run that is finished
  std::string reason;           ///< of a failure

  std::string line() const;
  /// False for a line that is not an event.
  static bool parse(std::string_view line, StudyEvent& event);
};

/// Progress over all runs of a study: on a terminal one line that is rewritten, else a line per finished run.
class StudyProgress {
 public:
  /// `processes`: number of parallel processes.
  StudyProgress(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                const study::Shard& shard, int processes);
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void on(const StudyEvent& event);
  /// Runs that failed and that no other process has finished since.
  std::size_t failed() const { return failed_.size(); }

 private:
  std::string summary() const;
  void print(const std::string& line, bool stays);

  const study::Plan& plan_;
  bool terminal_;
  double last_print_s_ = -1e9;
  int total_ = 0, done_ = 0;
  std::set<std::size_t> finished_;  ///< since the start
  std::set<std::size_t> failed_;
  study::TimeLeft time_left_;
  bool open_ = false;
};

/// Passes each event to a progress display, or writes it as a line for a parent.
class StudyReporter : public study::Listener {
 public:
  StudyReporter(const study::Plan& plan, StudyProgress* progress) : plan_(plan), progress_(progress) {}
  void on_start(const study::PlannedRun& run, int generations_done) override;
  void on_generation(const study::PlannedRun& run, int generations_done) override;
  void on_finish(const study::PlannedRun& run, const ledger::Record& record) override;
  void on_failure(const study::PlannedRun& run, const std::string& reason) override;

 private:
  void send(const StudyEvent& event);
  std::size_t index_of(const study::PlannedRun& run) const;

  const study::Plan& plan_;
  StudyProgress* progress_;  ///< null: lines on the standard output
  double last_line_s_ = -1e9;
};

}  // namespace amble::cli
