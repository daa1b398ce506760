#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>

#include "amble/experiment/plan/config.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/plan/progress.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/robot/spec.hpp"

namespace amble::experiment {

/// Receives the progress of a run. Called from the thread of Run::execute.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void on_generation(const GenerationRow& row, const Progress& progress, const Config& config) = 0;
};

enum class RunStatus { finished, interrupted };

/// One evolutionary run in its folder. After every generation its files are written, with a checkpoint from
/// which the run continues to the same bits as if it had never stopped.
class Run {
 public:
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;
  ~Run();

  /// A new run with `jobs` workers, at least 1; the results do not depend on their number. Throws UserError;
  /// then no existing file was changed.
  static Run start(const std::filesystem::path& folder, const Config& config, int jobs);
  /// The same with a robot that has been read already.
  static Run start(const std::filesystem::path& folder, const Config& config, const robot::RobotSpec& robot,
                   int jobs);
  /// Continues an existing run, to `generations` if given. Throws UserError.
  static Run resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs);

  /// Runs until all generations are done, or `stop` is set: then the generation in flight is discarded and
  /// the last checkpoint remains.
  RunStatus execute(RunListener& listener, const std::atomic<bool>& stop);

  const Config& config() const;
  const Progress& progress() const;
  const RunPaths& paths() const;
  /// The robot of its trials.
  const robot::RobotSpec& robot() const;
  /// How the trials ended that this object has made.
  const TrialTally& tally() const;
  /// Generations done.
  int generation() const;

 private:
  class State;
  explicit Run(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace amble::experiment
