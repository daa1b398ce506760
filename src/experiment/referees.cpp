#include "amble/experiment/referees.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "amble/experiment/replay.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {
namespace {

std::optional<Judgement> judge_in(const std::string& engine, const Problem& problem,
                                  const neat::Genome& genome, const RefereeOptions& options,
                                  const std::atomic<bool>& stop) {
  Judgement judgement{.engine = engine, .trials = {}};
  const std::size_t trials = std::max<std::size_t>(options.noise.size(), 1);
  for (std::size_t t = 0; t < trials; ++t) {
    ReplayOptions how{.seconds = options.seconds, .engine = engine, .trace = false};
    if (!options.noise.empty()) how.noise = options.noise[t];
    const auto trial = replay(problem, genome, how, stop);
    if (!trial) return std::nullopt;
    judgement.trials.push_back(trial->result);
  }
  return judgement;
}

}  // namespace

double Judgement::distance_m() const {
  std::vector<double> distances_m;
  for (const auto& trial : trials) distances_m.push_back(trial.distance_m);
  return statistics::median(distances_m);
}

std::optional<std::vector<Judgement>> judge(const Problem& problem, const neat::Genome& genome,
                                            const std::vector<std::string>& engines,
                                            const RefereeOptions& options, const std::atomic<bool>& stop) {
  const auto policy = options.jobs > 1 ? std::launch::async : std::launch::deferred;
  std::vector<std::future<std::optional<Judgement>>> judgements;
  judgements.reserve(engines.size());
  for (const auto& engine : engines)
    judgements.push_back(
        std::async(policy, [&] { return judge_in(engine, problem, genome, options, stop); }));
  std::vector<Judgement> judged;
  for (auto& judgement : judgements) {
    auto of_engine = judgement.get();
    if (!of_engine) return std::nullopt;
    judged.push_back(std::move(*of_engine));
  }
  return judged;
}

std::optional<std::vector<Refereed>> ask_referees(const Problem& problem, const neat::Genome& genome,
                                                  const std::vector<std::string>& engines, int jobs,
                                                  const std::atomic<bool>& stop) {
  const auto judged = judge(problem, genome, engines, {.jobs = jobs}, stop);
  if (!judged) return std::nullopt;
  std::vector<Refereed> refereed;
  for (const auto& [engine, trials] : *judged) refereed.push_back({engine, trials.front()});
  return refereed;
}

}  // namespace amble::experiment
