#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/run_folder.hpp"

namespace amble::experiment {

/// Decides whether the best genome of a generation becomes the run's champion: by its objective, or, with
/// `champion.episodes`, by its objective in as many further trials, the same for all genomes of the run and
/// none of which evolution meets. So one lucky evaluation cannot make a champion. Judgements follow from
/// genome, seed and config alone, so they are not stored: a resumed run judges its champion again. How the
/// trials are combined is `champion.score`.
class ChampionChoice {
 public:
  /// Keeps a pointer to `paths`.
  ChampionChoice(const Config& config, const Problem& problem, const RunPaths& paths);

  /// Whether the genome, which reached `objective` in its evaluation, is better than the champion of
  /// `progress`. If so, it is the champion from now on. Nothing if `stop` was set meanwhile. Throws UserError
  /// if the champion's file cannot be read.
  std::optional<bool> prefers(const neat::Genome& genome, double objective, const Progress& progress,
                              const std::atomic<bool>& stop);

 private:
  std::optional<double> judged(const neat::Genome& genome, const std::atomic<bool>& stop);

  Problem problem_;  ///< with the noise of the trials that decide
  const RunPaths* paths_;
  std::shared_ptr<const ground::Ground> ground_;
  std::vector<trial::Scenario> scenarios_;
  std::unique_ptr<Evaluator> evaluator_;
  std::optional<double> champion_;  ///< what the champion reached; nothing: not judged by this process
  /// The last one judged and what it reached: an elite is often the best of several generations.
  std::optional<std::pair<neat::Genome, double>> last_;
};

/// A genome of a generation that was better than all before.
struct NewBest {
  int generation = 0;
  int index = 0;  ///< among the generation's candidates
  const neat::Genome& genome;
  std::optional<double> objective = {};  ///< to be reached again; nothing: whatever it reaches
};

/// Runs it again without noise, in the episodes of its evaluation, and in the config's referees, and returns
/// the results. Adds to `times`. Nothing if `stop` was set meanwhile. Throws UserError(differs) if it does
/// not reach its objective again.
std::optional<Champion> try_champion(const Config& config, const Problem& problem, const NewBest& best,
                                     int jobs, StageTimes& times, const std::atomic<bool>& stop);

}  // namespace amble::experiment
