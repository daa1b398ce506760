#include "amble/search/cma_emitters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/search/weights.hpp"

namespace amble::search {
namespace {

// When an emitter begins again (as in pyribs): it is contracted, its distribution is a needle, or its
// candidates are worth the same.
constexpr double least_step = 1e-11, most_stretch = 1e7, least_difference = 1e-12;

constexpr double worthless = -std::numeric_limits<double>::infinity();

}  // namespace

CmaEmitters::CmaEmitters(const MapElitesSettings& settings, const SearchSpace& space, std::uint32_t cells)
    : settings_(settings.cma),
      genome_(space.neat.genome),
      innovations_(space.neat.innovations),
      inputs_(space.inputs),
      outputs_(space.outputs),
      seed_(space.seed),
      per_emitter_(settings.candidates_per_emitter()),
      thresholds_(cells, settings.cma.least_threshold) {
  genome_.initial_link_probability = 1.0;
  for (int emitter = 0; emitter < settings_.emitters; ++emitter)
    emitters_.push_back(distribution_around(initial_genome(emitter)));
}

neat::Genome CmaEmitters::initial_genome(int emitter) const {
  neat::Innovations innovations(inputs_, outputs_, innovations_);
  Stream stream(seed_, Purpose::cma_emitters, 0, static_cast<std::uint32_t>(emitter));
  return neat::initial_genome(genome_, inputs_, outputs_, innovations, stream);
}

CovarianceAdaptation CmaEmitters::distribution_around(const neat::Genome& genome) const {
  return {weights_of(genome), settings_.step, per_emitter_};
}

std::vector<neat::Genome> CmaEmitters::candidates(int round) const {
  std::vector<neat::Genome> candidates(emitters_.size() * to_index(per_emitter_), initial_genome(0));
  std::vector<double> normal(to_index(emitters_.front().dimensions()));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Stream stream(seed_, Purpose::cma_emitters, static_cast<std::uint32_t>(round + 1),
                  static_cast<std::uint32_t>(i));
    for (double& number : normal) number = stream.normal();
    set_weights(candidates[i], emitters_[i / to_index(per_emitter_)].sample(normal));
  }
  return candidates;
}

void CmaEmitters::tell(std::span<const neat::Genome> candidates, std::span<const Evaluation> evaluations,
                       std::span<const std::uint32_t> cells, const Elites& elites, int round) {
  AMBLE_CHECK(candidates.size() == emitters_.size() * to_index(per_emitter_) &&
                  evaluations.size() == candidates.size() && cells.size() == candidates.size(),
              "the candidates of a round");
  std::vector<double> improvements;
  for (std::size_t i = 0; i < evaluations.size(); ++i)
    improvements.push_back(evaluations[i].viable ? evaluations[i].objective - thresholds_[cells[i]]
                                                 : worthless);
  raise_thresholds(evaluations, cells, improvements);
  const auto share = to_index(per_emitter_);
  for (int emitter = 0; emitter < settings_.emitters; ++emitter)
    adapt(emitter, candidates.subspan(to_index(emitter) * share, share),
          std::span(improvements).subspan(to_index(emitter) * share, share), elites, round);
}

/// With n candidates above a threshold it goes 1 − (1 − rate)^n of the way to their mean: as if they had come
/// one by one, but in no order.
void CmaEmitters::raise_thresholds(std::span<const Evaluation> evaluations,
                                   std::span<const std::uint32_t> cells,
                                   std::span<const double> improvements) {
  std::vector<std::size_t> better;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (improvements[i] > 0.0) better.push_back(i);
  std::stable_sort(better.begin(), better.end(),
                   [&](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
  for (std::size_t first = 0, end = 0; first < better.size(); first = end) {
    const std::uint32_t cell = cells[better[first]];
    double sum = 0.0, kept = 1.0;
    for (end = first; end < better.size() && cells[better[end]] == cell; ++end) {
      sum += evaluations[better[end]].objective;
      kept *= 1.0 - settings_.learning_rate;
    }
    const double mean = sum / static_cast<double>(end - first);
    thresholds_[cell] = kept * thresholds_[cell] + (1.0 - kept) * mean;
  }
}

void CmaEmitters::adapt(int emitter, std::span<const neat::Genome> candidates,
                        std::span<const double> improvements, const Elites& elites, int round) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return improvements[a] > improvements[b]; });
  CovarianceAdaptation& distribution = emitters_[to_index(emitter)];
  std::vector<std::vector<double>> best_first;
  best_first.reserve(to_index(distribution.parents()));
  for (int parent = 0; parent < distribution.parents(); ++parent)
    best_first.push_back(weights_of(candidates[order[to_index(parent)]]));
  distribution.update(best_first);

  const double best = improvements[order.front()], worst = improvements[order.back()];
  const bool alike = !(best - worst >= least_difference);  // also where none is viable
  if (!alike && distribution.sound() && distribution.widest() > least_step &&
      distribution.widest() < most_stretch * distribution.narrowest())
    return;
  ++restarts_;
  if (elites.size() == 0) {
    distribution = distribution_around(initial_genome(settings_.emitters + restarts_));
    return;
  }
  Stream stream(seed_, Purpose::cma_emitters, static_cast<std::uint32_t>(round + 1),
                static_cast<std::uint32_t>(settings_.emitters * per_emitter_ + emitter));
  distribution = distribution_around(neat::expand(elites[stream.below(elites.size())].genome, "the map"));
}

void CmaEmitters::save(io::BinaryWriter& writer) const {
  writer.put(restarts_);
  // Most cells of a large map are as they were.
  std::vector<std::uint32_t> cells;
  std::vector<double> raised;
  for (std::uint32_t cell = 0; cell < thresholds_.size(); ++cell)
    if (thresholds_[cell] != settings_.least_threshold) {
      cells.push_back(cell);
      raised.push_back(thresholds_[cell]);
    }
  writer.put_span(std::span<const std::uint32_t>(cells));
  writer.put_span(std::span<const double>(raised));
  for (const CovarianceAdaptation& emitter : emitters_) emitter.save(writer);
}

void CmaEmitters::load(io::BinaryReader& reader) {
  restarts_ = reader.get<int>();
  const auto cells = reader.get_vector<std::uint32_t>();
  const auto raised = reader.get_vector<double>();
  if (restarts_ < 0 || cells.size() != raised.size()) reader.bad("emitters that cannot be");
  std::ranges::fill(thresholds_, settings_.least_threshold);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] >= thresholds_.size() || !std::isfinite(raised[i])) reader.bad("a threshold of another map");
    thresholds_[cells[i]] = raised[i];
  }
  for (CovarianceAdaptation& emitter : emitters_) emitter.load(reader);
}

}  // namespace amble::search
