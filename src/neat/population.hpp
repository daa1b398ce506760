#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/fitness.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// Statistics of a generation when it was speciated.
struct PopulationStatistics {
  int species = 0;                       ///< species that have members
  double compatibility_threshold = 0.0;  ///< under which they were made, after its corrections
  double mean_hidden = 0.0;              ///< hidden nodes per genome
  double mean_links = 0.0;               ///< enabled links per genome
};

/// One species of the present generation.
struct SpeciesStatistics {
  std::uint32_t id = 0;                     ///< never used again in a run once the species is extinct
  int size = 0;                             ///< members, at least 1
  int age = 0;                              ///< generations since it was founded
  int generations_without_improvement = 0;  ///< since its best objective rose, this generation not counted
};

/// A NEAT population, generation by generation. Its behaviour depends on settings, seed, and the fitness
/// given to it alone, to the bit; save() and load() cover all state.
class Population {
 public:
  /// Generation 0: genomes without hidden nodes, linked as the settings say, weights random. `inputs` ≥ 0
  /// does not count the bias, `outputs` ≥ 1; `recurrent`: whether links may close cycles. Throws SettingError
  /// as Settings::validate().
  Population(const Settings& settings, int inputs, int outputs, bool recurrent, std::uint64_t seed);
  ~Population();
  /// @{
  /// The one moved from is good for nothing but destruction and assignment.
  Population(Population&&) noexcept;
  Population& operator=(Population&&) noexcept;
  /// @}

  /// Number of the present generation, from 0.
  int generation() const;
  /// As many as PopulationSettings::size, in every generation; valid until advance() or load().
  std::span<const Genome> genomes() const;
  /// The present generation's, whose fitness is not known yet.
  PopulationStatistics statistics() const;
  /// The species, oldest first; their sizes add up to the size of the population.
  std::vector<SpeciesStatistics> species() const;

  /// Breeds the next generation from the fitness of this one, in the order of genomes(). Infinite fitness,
  /// NaN, a negative selection and another number of them than of genomes fail an AMBLE_CHECK.
  void advance(std::span<const Fitness> fitness);

  /// All state, for checkpoints.
  void save(io::BinaryWriter& writer) const;
  /// Replaces the state by what save() wrote, under the same settings; throws UserError(ExitCode::bad_file)
  /// if it does not fit, and then leaves the state as it was.
  void load(io::BinaryReader& reader);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace amble::neat
