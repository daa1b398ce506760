#include "amble/experiment/referees.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "amble/experiment/replay.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {
namespace {

std::optional<EngineResult> try_in_engine(const std::string& engine, const Problem& problem,
                                          const neat::Genome& genome, const RefereeOptions& options,
                                          const std::atomic<bool>& stop) {
  EngineResult result{.engine = engine, .trials = {}};
  const std::size_t trials = std::max<std::size_t>(options.noise.size(), 1);
  for (std::size_t t = 0; t < trials; ++t) {
    ReplayOptions how{.seconds = options.seconds, .engine = engine, .trace = false};
    if (!options.noise.empty()) how.noise = options.noise[t];
    const auto trial = replay(problem, genome, how, stop);
    if (!trial) return std::nullopt;
    result.trials.push_back(trial->result);
    if (options.on_trial) options.on_trial();
  }
  return result;
}

}  // namespace

double EngineResult::distance_m() const {
  std::vector<double> distances_m;
  for (const auto& trial : trials) distances_m.push_back(trial.distance_m);
  return statistics::median(distances_m);
}

std::optional<std::vector<EngineResult>> try_in_engines(const Problem& problem, const neat::Genome& genome,
                                                        const std::vector<std::string>& engines,
                                                        const RefereeOptions& options,
                                                        const std::atomic<bool>& stop) {
  const auto policy = options.jobs > 1 ? std::launch::async : std::launch::deferred;
  std::vector<std::future<std::optional<EngineResult>>> futures;
  futures.reserve(engines.size());
  for (const auto& engine : engines)
    futures.push_back(
        std::async(policy, [&] { return try_in_engine(engine, problem, genome, options, stop); }));
  std::vector<EngineResult> results;
  for (auto& future : futures) {
    auto of_engine = future.get();
    if (!of_engine) return std::nullopt;
    results.push_back(std::move(*of_engine));
  }
  return results;
}

std::optional<std::vector<RefereeResult>> run_referees(const Problem& problem, const neat::Genome& genome,
                                                       const std::vector<std::string>& engines, int jobs,
                                                       const std::atomic<bool>& stop) {
  const auto results = try_in_engines(problem, genome, engines, {.jobs = jobs}, stop);
  if (!results) return std::nullopt;
  std::vector<RefereeResult> referees;
  for (const auto& [engine, trials] : *results) referees.push_back({engine, trials.front()});
  return referees;
}

}  // namespace amble::experiment
