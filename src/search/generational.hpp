#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/neat/population.hpp"
#include "amble/search/criterion.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// Generational NEAT (Stanley & Miikkulainen 2002): a round is a population of constant size, the criterion
/// turns its evaluations into fitness, and NEAT breeds the next from it.
class GenerationalSearch : public Strategy {
 public:
  GenerationalSearch(neat::Population population, std::unique_ptr<Criterion> criterion);

  int round() const override { return population_.generation(); }
  std::span<const neat::Genome> ask() const override { return population_.genomes(); }
  void tell(std::span<const Evaluation> evaluations) override;

  std::vector<Metric> metrics() const override;
  void save(io::BinaryWriter& writer) const override;
  void load(io::BinaryReader& reader) override;

  std::vector<std::string> logs() const override;
  std::string take_log_growth(std::size_t i) override;
  std::uint64_t restore_log(std::size_t i, io::InputFile& file, const std::string& what) override;

  const neat::Population& population() const { return population_; }
  const Criterion& criterion() const { return *criterion_; }

 private:
  neat::Population population_;
  std::unique_ptr<Criterion> criterion_;
  neat::PopulationStatistics statistics_;  ///< of the last completed generation
};

/// Selects by the objective itself (the fitness-driven runs of Morse et al. 2013, sec. 4). Has no state.
class ObjectiveSearch : public Criterion {
 public:
  std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) override;
  void save(io::BinaryWriter&) const override {}
  void load(io::BinaryReader&) override {}
};

}  // namespace amble::search
