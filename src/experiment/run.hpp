#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_files.hpp"
#include "amble/experiment/run_folder.hpp"

namespace amble::experiment {

/// Receives the progress of a run. Called from the thread of Run::execute.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void on_generation(const GenerationRow& row, const Progress& progress, const Config& config) = 0;
};

class ChampionChoice;
struct EvaluatedGeneration;
class TypicalTrials;

enum class RunStatus { finished, interrupted };

/// One evolutionary run in its folder. After every generation its files are written, with a checkpoint from
/// which the run continues to the same bits as if it had never stopped.
class Run {
 public:
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

  const Config& config() const { return config_; }
  const Progress& progress() const { return state_.progress; }
  const RunPaths& paths() const { return folder_.paths(); }
  /// The robot of its trials.
  const robot::RobotSpec& robot() const { return problem_->robot; }
  /// How the trials ended that this object has made.
  const TrialTally& tally() const { return tally_; }
  /// Generations done.
  int generation() const { return state_.strategy->round(); }

 private:
  Run(RunFolder folder, const Config& config, std::unique_ptr<const Problem> problem, RunState state,
      RunFiles files, int jobs);

  RunStatus generations(RunListener& listener, const std::atomic<bool>& stop);
  /// Saves the best of a generation if it becomes the champion; false if `stop` was set meanwhile.
  bool keep_best(std::span<const neat::Genome> candidates, std::span<const double> objectives,
                 ChampionChoice& choice, TypicalTrials& typical, GenerationRow& row,
                 const std::atomic<bool>& stop);
  /// Measures what the champion typically does; false if `stop` was set meanwhile.
  bool measure_typical(TypicalTrials& trials, const neat::Genome& champion, const std::atomic<bool>& stop);
  void tell(const EvaluatedGeneration& evaluated, GenerationRow& row);

  RunFolder folder_;
  Config config_;
  std::unique_ptr<const Problem> problem_;
  std::unique_ptr<const score::Behaviour> behaviour_;
  RunState state_;
  RunFiles files_;
  GenerationGround ground_;
  TrialTally tally_;
  int jobs_;
};

}  // namespace amble::experiment
