#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// What a search says of one genome.
struct Fitness {
  double selection = 0.0;  ///< ≥ 0: decides offspring counts and the roulette (novelty, or the objective itself)
  double objective = 0.0;  ///< ranks the members of a species: elites and the survival cut (Morse et al. 2013, sec. 4)
};

/// What a generation looked like when it was speciated.
struct PopulationStatistics {
  int species = 0;
  double compatibility_threshold = 0.0;
  double mean_hidden = 0.0;
  double mean_links = 0.0;
};

/// A NEAT population, generation by generation. Everything it does depends on settings, seed, and the fitness it was given,
/// to the bit; all state is in save() and load().
class Population {
 public:
  /// Generation 0: genomes without hidden nodes, linked as the settings say, weights random.
  Population(const Settings& settings, int inputs, int outputs, bool recurrent, std::uint64_t seed);
  ~Population();
  Population(Population&&) noexcept;
  Population& operator=(Population&&) noexcept;

  int generation() const;
  std::span<const Genome> genomes() const;
  PopulationStatistics statistics() const;

  /// Breeds the next generation from the fitness of this one, in the order of genomes().
  void advance(std::span<const Fitness> fitness);

  void save(io::BinaryWriter& writer) const;
  /// Replaces the state by what save() wrote, under the same settings; throws UserError(ExitCode::bad_file) if it does not fit.
  void load(io::BinaryReader& reader);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace amble::neat
