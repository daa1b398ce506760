#include "amble/experiment/trial_memory.hpp"

#include <cstddef>
#include <unordered_map>
#include <utility>

namespace amble::experiment {
namespace {

struct GenomeHash {
  std::size_t operator()(const neat::Genome* genome) const { return genome->hash(); }
};
struct GenomesEqual {
  bool operator()(const neat::Genome* a, const neat::Genome* b) const { return *a == *b; }
};
/// Indices of genomes that outlive it.
using Places = std::unordered_map<const neat::Genome*, std::size_t, GenomeHash, GenomesEqual>;

/// Where the trials of a genome are.
struct Source {
  bool known = false;     ///< in the call before; otherwise among those tried now
  std::size_t place = 0;  ///< the genome's
};

}  // namespace

std::optional<GenerationResult> TrialMemory::evaluate(Evaluator& evaluator,
                                                      std::span<const neat::Genome> genomes,
                                                      const std::atomic<bool>& stop, const TrialDraw& draw,
                                                      std::span<const trial::Scenario> scenarios,
                                                      const std::shared_ptr<const ground::Ground>& ground) {
  Places known, open;
  if (draw_ == draw)
    for (std::size_t i = 0; i < genomes_.size(); ++i) known.try_emplace(&genomes_[i], i);
  std::vector<Source> sources;
  std::vector<neat::Genome> tried;
  for (const neat::Genome& genome : genomes) {
    if (const auto found = known.find(&genome); found != known.end()) {
      sources.push_back({.known = true, .place = found->second});
      continue;
    }
    const auto [found, is_new] = open.try_emplace(&genome, tried.size());
    if (is_new) tried.push_back(genome);
    sources.push_back({.known = false, .place = found->second});
  }

  auto result = evaluator.evaluate(tried, stop, scenarios, ground);
  if (!result) return std::nullopt;
  std::vector<record::Trajectory> trajectories;
  trajectories.reserve(genomes.size() * result->episodes);
  result->steps = 0;
  for (const auto& [is_known, place] : sources) {
    const auto& from = is_known ? trajectories_ : result->trajectories;
    for (const auto& trajectory : std::span(from).subspan(place * result->episodes, result->episodes)) {
      trajectories.push_back(trajectory);
      result->steps += static_cast<std::uint64_t>(trajectory.steps);
    }
  }
  draw_ = draw;
  genomes_.assign(genomes.begin(), genomes.end());
  trajectories_ = trajectories;
  result->trajectories = std::move(trajectories);
  return result;
}

}  // namespace amble::experiment
