#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/settings.hpp"
#include "amble/search/covariance_adaptation.hpp"
#include "amble/search/elites.hpp"
#include "amble/search/evaluation.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategies.hpp"

namespace amble::search {

/// What fills a map by covariance matrix adaptation: CMA-MAE (Fontaine & Nikolaidis, "Covariance Matrix
/// Adaptation MAP-Annealing", GECCO 2023, arXiv 2205.10752) on the weights of CPPNs that do not grow. Each
/// emitter samples its share of a batch, ranks it by how far each objective exceeds the threshold of its
/// cell, and moves towards the better half. Thresholds of cells then rise towards what exceeded them, all of
/// a batch at once (as in pyribs). An emitter that has contracted to nothing, or whose candidates are all
/// alike, begins again at any elite of the map. Candidates that are not viable rank last; where fewer than
/// half are viable, some that are not are among the better half.
///
/// Thresholds know nothing of elites that are evaluated again: a cell that loses its elite so keeps the
/// threshold that its first evaluations raised.
///
/// Its genomes are the initial one, in which bias and inputs are linked with all outputs. Results depend on
/// settings, seed and evaluations alone, to the bit.
class CmaEmitters {
 public:
  /// `settings` must be valid; `cells` of the map.
  CmaEmitters(const MapElitesSettings& settings, const SearchSpace& space, std::uint32_t cells);

  /// The candidates of a round: emitters × candidates_per_emitter(), emitter by emitter.
  std::vector<neat::Genome> candidates(int round) const;
  /// Takes the evaluations of candidates(round), and in which cell each is; of those that are not viable any.
  /// `elites`: the map with the viable ones.
  void tell(std::span<const neat::Genome> candidates, std::span<const Evaluation> evaluations,
            std::span<const std::uint32_t> cells, const Elites& elites, int round);

  /// How often emitters have begun again.
  int restarts() const { return restarts_; }
  /// What a candidate of this cell must exceed.
  double threshold(std::uint32_t cell) const { return thresholds_[cell]; }

  void save(io::BinaryWriter& writer) const;
  /// Throws UserError(bad_file) for what belongs to another map or other genomes.
  void load(io::BinaryReader& reader);

 private:
  neat::Genome initial_genome(int emitter) const;
  CovarianceAdaptation distribution_around(const neat::Genome& genome) const;
  void raise_thresholds(std::span<const Evaluation> evaluations, std::span<const std::uint32_t> cells,
                        std::span<const double> improvements);
  void adapt(int emitter, std::span<const neat::Genome> candidates, std::span<const double> improvements,
             const Elites& elites, int round);

  CmaEmitterSettings settings_;
  neat::GenomeSettings genome_;
  neat::InnovationSettings innovations_;
  int inputs_, outputs_;
  std::uint64_t seed_;
  int per_emitter_;
  int restarts_ = 0;
  std::vector<double> thresholds_;  ///< by cell
  std::vector<CovarianceAdaptation> emitters_;
};

}  // namespace amble::search
