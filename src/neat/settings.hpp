#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::neat {

// The defaults are the numbers of Morse et al. 2013 and of the authors' code, which builds on HyperSharpNEAT.
// settings.cpp documents the meaning, unit and source of each.

struct PopulationSettings {
  int size = 300;

  void describe(io::SettingsVisitor& visitor);
};

/// Structure of genomes, initially and as they grow.
struct GenomeSettings {
  double weight_limit = 1.5;
  double initial_link_probability = 1.0;
  Activation output_activation = Activation::bipolar_sigmoid;
  /// Shares of the functions of new hidden nodes, in the order of `activation_names`.
  std::array<double, 4> activation_shares{0.25, 0.25, 0.25, 0.25};

  void describe(io::SettingsVisitor& visitor);
};

/// Changes to a genome's weights by the operator "weights": one of five kinds is drawn. Jiggling adds a
/// uniform number within ±jiggle_limit, resetting draws the weight anew.
struct WeightMutationSettings {
  double jiggle_limit = 0.05;
  double jiggle_many_share = 0.125, jiggle_many_probability = 0.5;
  double jiggle_few_share = 0.125, jiggle_few_probability = 0.1;
  double jiggle_one_share = 0.125;
  double reset_few_share = 0.5, reset_few_probability = 0.1;
  double reset_one_share = 0.125;

  void describe(io::SettingsVisitor& visitor);
};

/// Treatment of the link that a new node splits.
enum class SplitLink {
  remove,  ///< deleted (the authors' code)
  disable  ///< kept, but disabled (Stanley & Miikkulainen 2002, sec. 3.1)
};
inline constexpr std::array<std::string_view, 2> split_link_names{"remove", "disable"};

/// The four shares are those of a roulette that picks one operator per mutated genome; they need not add up
/// to 1.
struct MutationSettings {
  double weights_share = 0.96;
  double add_link_share = 0.06;
  double add_node_share = 0.01;
  double delete_link_share = 0.0;
  SplitLink split_link = SplitLink::remove;
  WeightMutationSettings weights;

  void describe(io::SettingsVisitor& visitor);
};

/// How the genes that only the weaker parent has are inherited.
enum class WeakerGenes { all_or_none, one_by_one };
inline constexpr std::array<std::string_view, 2> weaker_genes_names{"all_or_none", "one_by_one"};

/// How long a structural mutation keeps its number: until the next generation is bred, or for ever.
enum class InnovationScope { generation, run };
inline constexpr std::array<std::string_view, 2> innovation_scope_names{"generation", "run"};

/// What identifies a new node: the link that it splits, or also its function.
enum class InnovationKey { link, link_and_function };
inline constexpr std::array<std::string_view, 2> innovation_key_names{"link", "link_and_function"};

/// Which structural mutations get the same number (Stanley & Miikkulainen 2002, sec. 3.2).
struct InnovationSettings {
  InnovationScope scope = InnovationScope::generation;
  InnovationKey key = InnovationKey::link;

  void describe(io::SettingsVisitor& visitor);
};

struct CrossoverSettings {
  WeakerGenes weaker_genes = WeakerGenes::all_or_none;
  double weaker_genes_probability = 0.1;
  double enable_probability = 0.25;
  bool mutate_child = false;

  void describe(io::SettingsVisitor& visitor);
};

/// Coefficients of the compatibility distance (Stanley & Miikkulainen 2002, eq. 1).
struct DistanceSettings {
  double excess = 1.0;
  double disjoint = 1.0;
  double weight = 3.0;
  bool normalised = false;
};

struct SpeciationSettings {
  DistanceSettings distance;
  double initial_threshold = 100.0;
  int target_min = 28;
  int target_max = 30;
  double first_step_down = 0.01, first_step_up = 0.5;
  int corrections_per_generation = 1;

  void describe(io::SettingsVisitor& visitor);
  /// The targets for a population of another size than 300, in the same proportion to it and at least 1.
  void scale_targets(int population);
};

/// How a species with a single place in the next generation fills it.
enum class LonePlace { elite, child };
inline constexpr std::array<std::string_view, 2> lone_place_names{"elite", "child"};

struct ReproductionSettings {
  double survival = 0.8;
  double elitism = 0.1;
  LonePlace lone_place = LonePlace::child;
  double asexual_probability = 0.5;
  double interspecies_probability = 0.01;
  int stagnation_generations = 1500;
  double stagnation_factor = 0.01;

  void describe(io::SettingsVisitor& visitor);
};

/// All settings of NEAT. Their tables are at the top level of a config: population.size,
/// mutation.add_link_share, …
struct Settings {
  PopulationSettings population;
  GenomeSettings genome;
  MutationSettings mutation;
  InnovationSettings innovations;
  CrossoverSettings crossover;
  SpeciationSettings speciation;
  ReproductionSettings reproduction;

  void describe(io::SettingsVisitor& visitor);
  /// The rules that join several settings. Throws UserError naming the key; single values are checked by
  /// describe()'s ranges.
  void validate() const;
};

}  // namespace amble::neat
