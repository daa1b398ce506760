#include "amble/presentation/shown_trial.hpp"

namespace amble::presentation {

experiment::TypicalLevel level_of(const experiment::Problem& problem, const TrialChoice& choice) {
  return choice.noise ? experiment::level_of_config(*choice.noise)
                      : experiment::typical_level(problem, choice.level);
}

experiment::TypicalTrials typical_trials(const experiment::Problem& problem, std::int64_t seed,
                                         const TrialChoice& choice, int jobs) {
  const int trials = choice.trials > 0 ? choice.trials : experiment::reported_trials(problem.engine);
  return {problem, seed, trials, level_of(problem, choice), jobs};
}

std::optional<ShownTrial> shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                      const std::optional<std::string>& engine, const TrialChoice& choice,
                                      int jobs, const std::atomic<bool>& stop) {
  experiment::Problem problem = champion.problem;
  if (choice.undisturbed) return ShownTrial{.noise = problem.noise, .key = {}, .typical = {}};
  const bool evolved_without = !choice.asked() && !problem.trials_vary();
  if (seconds) problem.trial.duration_s = *seconds;
  if (engine) problem.engine = *engine;
  problem.trial.validate();
  auto trials = typical_trials(problem, champion.seed, choice, jobs);
  const auto median = experiment::median_trial(trials, champion.genome, champion.seed, stop);
  if (!median) return std::nullopt;
  ShownTrial shown{
      .noise = problem.noise,
      .key = {},
      .typical = experiment::typical_text(median->distance, {}, problem.trial.duration_s, median->under)};
  if (!evolved_without) {
    shown.noise = median->problem.noise;
    shown.key = median->key;
  }
  return shown;
}

}  // namespace amble::presentation
