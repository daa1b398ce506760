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

struct Problem;

/// Receives the progress of a run. Called from the thread of Run::execute.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// After each generation, when its files are written. `progress` includes it.
  virtual void on_generation(const GenerationRow& row, const Progress& progress, const Config& config) = 0;
};

/// How Run::execute() ended.
enum class RunStatus {
  finished,    ///< all generations are done
  interrupted  ///< `stop` was set
};

/// One evolutionary run in its folder, which it locks as long as it lives (docs/FORMATS.md). After every
/// generation its files are written, with a checkpoint from which the run continues to the same bits as if it
/// had never stopped.
class Run {
 public:
  /// Can be moved; what is left of it is good for nothing but destruction.
  Run(Run&&) noexcept;
  /// As the constructor.
  Run& operator=(Run&&) noexcept;
  ~Run();

  /// A new run with `jobs` workers, at least 1; the results do not depend on their number. `config` is valid.
  /// Throws UserError: the robot or its file is not fit for the config, the folder holds something already or
  /// cannot be written (ExitCode::io), is locked (locked), or the search could need more memory than there
  /// is. Then no existing file was changed.
  static Run start(const std::filesystem::path& folder, const Config& config, int jobs);
  /// The same with a robot that has been read already, as load_robot() gives it.
  static Run start(const std::filesystem::path& folder, const Config& config, const robot::RobotSpec& robot,
                   int jobs);
  /// Continues an existing run, to `generations` if given, which may be more or fewer than its config had,
  /// but not fewer than are done. Throws UserError: the folder is no run, is locked (ExitCode::locked), its
  /// files are altered (bad_file), or `generations` are too few.
  static Run resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs);

  /// Runs until all generations are done, or `stop` is set: then the generation in flight is discarded, with
  /// the one before if its best is still being tried, and the last checkpoint remains. With several workers
  /// an error is thrown once the evaluation in flight has ended. Throws UserError: files cannot be written
  /// (ExitCode::io), the engine does not repeat a champion (differs), memory is used up (io); and what the
  /// listener throws. The run can be resumed from its last checkpoint then.
  RunStatus execute(RunListener& listener, const std::atomic<bool>& stop);

  /// That of the run, with the generations that it goes to.
  const Config& config() const;
  /// What is done, that of earlier processes included.
  const Progress& progress() const;
  /// Its files.
  const RunPaths& paths() const;
  /// The robot of its trials, on its ground (Problem::robot).
  const robot::RobotSpec& robot() const;
  /// What maps its genomes to trajectories.
  const Problem& problem() const;
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
