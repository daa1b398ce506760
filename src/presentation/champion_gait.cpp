#include "amble/presentation/champion_gait.hpp"

#include <utility>

#include "amble/experiment/gait_observer.hpp"
#include "amble/experiment/replay.hpp"

namespace amble::presentation {

std::optional<ChampionGait> champion_gait(const experiment::Champion& champion, const std::string& origin,
                                          std::optional<double> seconds,
                                          const std::optional<std::string>& engine,
                                          const gait::Settings& settings, const TrialChoice& choice, int jobs,
                                          const std::atomic<bool>& stop) {
  auto shown = shown_trial(champion, seconds, engine, choice, jobs, stop);
  if (!shown) return std::nullopt;
  experiment::Problem problem = champion.problem;
  problem.noise = shown->noise;
  experiment::GaitObserver observer(problem, settings);
  const auto replay = experiment::replay(problem, champion.genome,
                                         {.seconds = seconds,
                                          .engine = engine,
                                          .record = {},
                                          .origin = origin,
                                          .observer = &observer,
                                          .trace = false,
                                          .noise = shown->key},
                                         stop);
  if (!replay) return std::nullopt;
  return ChampionGait{std::move(*shown), observer.finish(replay->result.outcome)};
}

}  // namespace amble::presentation
