#include "amble/experiment/referees.hpp"

#include <future>

#include "amble/experiment/replay.hpp"

namespace amble::experiment {

std::optional<std::vector<Refereed>> ask_referees(const Problem& problem, const neat::Genome& genome,
                                                  const std::vector<std::string>& engines,
                                                  const RefereeOptions& options,
                                                  const std::atomic<bool>& stop) {
  const auto policy = options.jobs > 1 ? std::launch::async : std::launch::deferred;
  std::vector<std::future<std::optional<Replay>>> trials;
  trials.reserve(engines.size());
  for (const auto& engine : engines)
    trials.push_back(std::async(policy, [&] {
      return replay(problem, genome, {.seconds = options.seconds, .engine = engine, .trace = false}, stop);
    }));
  std::vector<Refereed> judged;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto trial = trials[i].get();
    if (!trial) return std::nullopt;
    judged.push_back({engines[i], trial->result});
  }
  return judged;
}

}  // namespace amble::experiment
