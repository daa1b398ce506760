#include "amble/presentation/shown_trial.hpp"

namespace amble::presentation {

experiment::TypicalTrials typical_trials(const experiment::Problem& problem, std::int64_t seed,
                                         const TrialChoice& choice, int jobs) {
  const int trials = choice.trials > 0 ? choice.trials : experiment::reported_trials(problem.engine);
  return {problem, seed, trials, choice.level, jobs};
}

std::optional<ShownTrial> shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                      const std::optional<std::string>& engine, const TrialChoice& choice,
                                      int jobs, const std::atomic<bool>& stop) {
  experiment::Problem problem = champion.problem;
  if (choice.undisturbed || (!choice.asked() && !problem.disturbed()))
    return ShownTrial{.noise = problem.noise, .key = {}, .typical = {}};
  if (seconds) problem.trial.duration_s = *seconds;
  if (engine) problem.engine = *engine;
  problem.trial.validate();
  auto trials = typical_trials(problem, champion.seed, choice, jobs);
  const auto median = experiment::median_trial(trials, champion.genome, champion.seed, stop);
  if (!median) return std::nullopt;
  return ShownTrial{
      .noise = median->problem.noise,
      .key = median->key,
      .typical = experiment::typical_text(median->distance, {}, problem.trial.duration_s, median->under)};
}

}  // namespace amble::presentation
