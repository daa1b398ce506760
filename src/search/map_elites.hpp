#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "amble/core/circle.hpp"
#include "amble/core/random.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/search/cells.hpp"
#include "amble/search/challengers.hpp"
#include "amble/search/cma_emitters.hpp"
#include "amble/search/dominated_pool.hpp"
#include "amble/search/elite_log.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategies.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// A full turn of each descriptor, in parts of its range; 0 where it is none of a circle. As many circles as
/// descriptors.
std::vector<double> turns_of(const MapElitesSettings& settings, std::span<const Circle> circles);

/// MAP-Elites (Mouret & Clune 2015) with NEAT's genomes: keeps the best genome of each cell of a map over
/// descriptors (Evaluation::behaviour). A round is a batch: random genomes at first, then mutated copies of
/// elites, or children of two, and elites that are evaluated again. Under Variation::line and Variation::cma
/// only weights change, and under the latter candidates come from distributions (cma_emitters.hpp).
///
/// - A candidate enters the cell of its descriptor if that is empty, or if its objective is larger than that
///   of the elite there. One whose evaluation is not viable never does.
/// - An elite that is evaluated again has the means of all its evaluations as its objective and descriptor,
///   those of an angle the short way round. If these belong to another cell, it leaves its own, which is
///   empty then, and enters that by the same rule, or is lost. So an elite that was lucky once falls back to
///   what it is worth.
class MapElites : public Strategy {
 public:
  /// The settings must be valid, and `space.neat` innovations of a generation's scope.
  MapElites(const MapElitesSettings& settings, const SearchSpace& space);

  int round() const override { return round_; }
  std::span<const neat::Genome> ask() const override { return candidates_; }
  void tell(std::span<const Evaluation> evaluations) override;

  std::vector<Metric> metrics() const override;
  void save(io::BinaryWriter& writer) const override;
  void load(io::BinaryReader& reader) override;

  std::vector<std::string> logs() const override { return {"archive.bin"}; }
  std::string take_log_growth(std::size_t i) override;
  std::uint64_t restore_log(std::size_t i, io::InputFile& file, const std::string& what) override;

  const Elites& elites() const { return map_.elites(); }

 private:
  /// Where a candidate comes from.
  struct Origin {
    enum class Kind { child, again, challenger } kind = Kind::child;
    EliteName elite;  ///< its (first) parent, or of `again` itself; of no elite: a random genome
  };
  /// What a round changed.
  struct Counts {
    int entered = 0, improved = 0, reevaluated = 0, moved = 0, lost = 0;
  };

  /// A genome of which children are bred.
  struct Parent {
    const std::string* genome = nullptr;  ///< compact
    double objective = 0.0;
    EliteName elite;  ///< of no elite: a challenger, or of the pool
  };

  void breed();
  void add_samples();
  void add_elite_again(std::uint32_t cell);
  void add_child(Stream& stream);
  Parent draw(Stream& stream) const;
  Parent parent(std::uint32_t number) const;
  static neat::Genome expanded(const Parent& parent);
  bool is_there(const EliteName& elite) const;
  bool would_enter(const Elite& elite) const;
  std::uint32_t most_evaluations(std::uint32_t cell) const;
  bool prevails(const Elite& elite, std::span<const float> descriptor) const;

  void tell_emitters(std::span<const Evaluation> evaluations);
  void fill_pool(std::span<const Evaluation> evaluations);
  void take_child(std::uint32_t candidate, const Evaluation& evaluation);
  void add_evaluation(Elite& elite, std::vector<float>& descriptor, const Evaluation& evaluation) const;
  void reevaluate(const EliteName& elite, const Evaluation& evaluation);
  void take_challenger(Challenger challenger, const Evaluation& evaluation);
  void decide(Challenger challenger);
  void credit_parent(const EliteName& parent, bool entered);

  MapElitesSettings settings_;
  neat::Settings neat_;
  int inputs_, outputs_;
  bool recurrent_;
  std::uint64_t seed_;
  std::vector<Circle> circles_;  ///< of the descriptors
  std::unique_ptr<const Cells> cells_;

  int round_ = 0;
  LoggedElites map_;
  std::vector<Challenger> challengers_;  ///< in the order of their candidates
  std::vector<float> curiosity_;         ///< by cell; empty unless parents are drawn by it
  std::optional<CmaEmitters> emitters_;  ///< under Variation::cma
  std::optional<DominatedPool> pool_;    ///< under Selection::dominated
  neat::Innovations before_;  ///< before the candidates were bred: with them save() need not write these
  neat::Innovations innovations_;
  Counts counts_;  ///< of the last completed round

  std::vector<neat::Genome> candidates_;
  std::vector<Origin> origins_;
  std::vector<float> loaded_curiosity_;  ///< between load() and restore_log(), by elite
};

}  // namespace amble::search
