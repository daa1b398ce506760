#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/neat/population.hpp"
#include "amble/search/criterion.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// Generational NEAT (Stanley & Miikkulainen 2002): a round is a population of constant size, the criterion
/// turns its evaluations into fitness, and NEAT breeds the next from it. save() and load() throw and cover
/// what population and criterion do; the log is the criterion's archive.
class GenerationalSearch : public Strategy {
 public:
  /// `population` as neat::Population makes it. `criterion` is not null.
  GenerationalSearch(neat::Population population, std::unique_ptr<Criterion> criterion);

  int round() const override { return population_.generation(); }
  std::span<const neat::Genome> ask() const override { return population_.genomes(); }
  /// AMBLE_CHECK: there is one evaluation per candidate, and the criterion makes fitness of them that NEAT
  /// takes (neat::Population::advance).
  void tell(std::span<const Evaluation> evaluations) override;

  /// "species", "threshold" (of compatibility), "mean_hidden", "mean_links", then the criterion's, all
  /// of the round told last; 0 before.
  std::vector<Metric> metrics() const override;
  void save(io::BinaryWriter& writer) const override;
  void load(io::BinaryReader& reader) override;

  /// "archive.bin", if the criterion has an archive.
  std::vector<std::string> logs() const override;
  std::string take_log_growth(std::size_t i) override;
  std::uint64_t restore_log(std::size_t i, io::InputFile& file, const std::string& what) override;

  /// The candidates of the current round, and their species.
  const neat::Population& population() const { return population_; }
  /// What selects.
  const Criterion& criterion() const { return *criterion_; }

 private:
  neat::Population population_;
  std::unique_ptr<Criterion> criterion_;
  neat::PopulationStatistics statistics_;  ///< of the last completed generation
};

/// Selects by the objective itself (the fitness-driven runs of Morse et al. 2013, sec. 4). Has no state.
class ObjectiveSearch : public Criterion {
 public:
  /// The objective as both members of neat::Fitness. AMBLE_CHECK: it is finite and ≥ 0.
  std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) override;
  void save(io::BinaryWriter&) const override {}
  void load(io::BinaryReader&) override {}
};

}  // namespace amble::search
