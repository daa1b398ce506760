#pragma once

#include <atomic>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/generation_row.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/neat/population.hpp"
#include "amble/search/search.hpp"

namespace amble::experiment {

/// Hears how a run goes. Called from the thread of Run::execute.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void on_generation(const GenerationRow& row, const Progress& progress, const Config& config) = 0;
};

enum class RunStatus { finished, interrupted };

/// One evolutionary run in its folder. After every generation its files are written, with a checkpoint from
/// which the run goes on to the same bits as if it had never stopped.
class Run {
 public:
  /// A new run by `jobs` workers, at least 1; the results do not depend on their number. Throws UserError;
  /// then nothing was written over.
  static Run start(const std::filesystem::path& folder, const Config& config, int jobs);
  /// Goes on with an old one, to `generations` if given. Throws UserError.
  static Run resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs);

  /// Until all generations are done, or `stop` is set: then the generation in flight is dropped and the
  /// checkpoint stands.
  RunStatus execute(RunListener& listener, const std::atomic<bool>& stop);

  const Config& config() const { return config_; }
  const Progress& progress() const { return progress_; }
  const RunPaths& paths() const { return folder_.paths(); }
  int generation() const { return population_.generation(); }

 private:
  Run(RunFolder folder, const Config& config, const robot::RobotSpec& robot, int jobs);

  /// What these do, and how long it takes, is noted in `row`. The best genome's objective is row.best_m; it
  /// is run again, here and in the referees; false if `stop` was set meanwhile.
  bool keep_champion(std::size_t best, GenerationRow& row, const std::atomic<bool>& stop);
  std::vector<neat::Fitness> judge(const GenerationResult& result, std::span<const double> distances_m,
                                   GenerationRow& row);
  void breed(std::span<const neat::Fitness> fitness, GenerationRow& row);
  RunStatus generations(RunListener& listener, const std::atomic<bool>& stop);
  /// Takes everything back from a checkpoint and what belongs to it. Returns how many bytes of the archive's
  /// file belong to it; nothing without an archive. Throws UserError.
  std::optional<std::uint64_t> restore(const std::filesystem::path& checkpoint);
  /// The same from the newest one that is whole, as are the files that it counts on.
  std::optional<std::uint64_t> restore_newest();
  /// Throws UserError if the file of the best champion is gone, damaged or another one, which would go
  /// unnoticed else.
  void check_best() const;
  /// All files but the champions, in an order from which a run goes on wherever it is cut off. They are
  /// written when it returns, so that nothing is lost with the process, and synced while the next generation
  /// is evaluated.
  void write_down(const GenerationRow& row);
  /// Waits until what write_down() wrote is on the disk. Throws UserError.
  void settle();

  RunFolder folder_;
  Config config_;
  std::unique_ptr<const Problem> problem_;
  neat::Population population_;
  std::unique_ptr<search::Search> search_;
  std::unique_ptr<io::AppendFile> csv_, archive_;  ///< without an archive, the latter is null
  Progress progress_;
  int jobs_;
  double files_s_ = 0.0;  ///< spent on the files of the last row
  std::future<void> settling_;
};

}  // namespace amble::experiment
