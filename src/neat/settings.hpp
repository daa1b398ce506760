#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"
#include "amble/neat/genome.hpp"

// The defaults are the numbers of Morse et al. 2013 and of the authors' code, which builds on HyperSharpNEAT;
// `amble settings` names the source of each. Ranges are those that describe() holds a config to. A share is a
// weight in a roulette, 0 … 1e6: what counts is its part of the sum, which need not be 1.

namespace amble::neat {

/// The genomes of a generation.
struct PopulationSettings {
  int size = 300;  ///< genomes per generation, 2 … 1e6 (Morse et al. 2013, sec. 4)

  void describe(io::SettingsVisitor& visitor);  ///< the table [population]
};

/// Structure of genomes, initially and as they grow.
struct GenomeSettings {
  /// New weights are uniform within ± this, 0.001 … 1000, and NEAT's mutation keeps them in it. CMA-ES,
  /// CMA-MAE and lines between elites only begin there.
  double weight_limit = 1.5;
  double initial_link_probability = 1.0;  ///< that a link from bias or an input to an output exists, 0 … 1
  Activation output_activation = Activation::bipolar_sigmoid;  ///< function of all output nodes
  /// Shares of the functions of new hidden nodes, in the order of `activation_names`. Their sum is positive.
  std::array<double, 4> activation_shares{0.25, 0.25, 0.25, 0.25};

  void describe(io::SettingsVisitor& visitor);  ///< the table [genome]
};

/// Changes to a genome's weights by the operator "weights": one of five kinds is drawn by their shares.
/// Jiggling adds a uniform number within ±jiggle_limit, resetting draws the weight anew. A probability, 0 …
/// 1, is that of each link; if it takes none, one link is drawn.
struct WeightMutationSettings {
  double jiggle_limit = 0.05;         ///< in the unit of weights, 0 … 1000
  double jiggle_many_share = 0.125,   ///< share of jiggling many links
      jiggle_many_probability = 0.5;  ///< probability of each link then
  double jiggle_few_share = 0.125,    ///< share of jiggling few links
      jiggle_few_probability = 0.1;   ///< probability of each link then
  double jiggle_one_share = 0.125;    ///< share of jiggling one link
  double reset_few_share = 0.5,       ///< share of drawing few weights anew
      reset_few_probability = 0.1;    ///< probability of each link then
  double reset_one_share = 0.125;     ///< share of drawing one weight anew

  void describe(io::SettingsVisitor& visitor);  ///< the table [mutation.weights]
};

/// Treatment of the link that a new node splits.
enum class SplitLink {
  remove,  ///< deleted (the authors' code)
  disable  ///< kept, but disabled (Stanley & Miikkulainen 2002, sec. 3.1)
};
/// As configs write them, by SplitLink.
inline constexpr std::array<std::string_view, 2> split_link_names{"remove", "disable"};

/// How a genome is mutated: one operator per mutated genome, drawn by the four shares, of which one at least
/// is positive. They need not add up to 1.
struct MutationSettings {
  double weights_share = 0.96;               ///< share of changing weights, as `weights` says
  double add_link_share = 0.06;              ///< share of adding a link (Morse et al. 2013, sec. 4)
  double add_node_share = 0.01;              ///< share of splitting a link by a node (the same)
  double delete_link_share = 0.0;            ///< share of deleting a link
  SplitLink split_link = SplitLink::remove;  ///< what becomes of the link that a new node splits
  WeightMutationSettings weights;            ///< how weights change

  void describe(io::SettingsVisitor& visitor);  ///< the table [mutation]
};

/// How the genes that only the weaker parent has are inherited.
enum class WeakerGenes {
  all_or_none,  ///< all of them or none, by one draw for the child (HyperSharpNEAT)
  one_by_one    ///< each by a draw of its own
};
/// As configs write them, by WeakerGenes.
inline constexpr std::array<std::string_view, 2> weaker_genes_names{"all_or_none", "one_by_one"};

/// How long a structural mutation keeps its number.
enum class InnovationScope {
  generation,  ///< until the next generation is bred (Stanley & Miikkulainen 2002, sec. 3.2)
  run          ///< for ever; the list of numbers grows with the run
};
/// As configs write them, by InnovationScope.
inline constexpr std::array<std::string_view, 2> innovation_scope_names{"generation", "run"};

/// What identifies a new node.
enum class InnovationKey {
  link,              ///< the link that it splits: nodes of one id may differ in function (the authors' code)
  link_and_function  ///< that and its function
};
/// As configs write them, by InnovationKey.
inline constexpr std::array<std::string_view, 2> innovation_key_names{"link", "link_and_function"};

/// Which structural mutations get the same number (Stanley & Miikkulainen 2002, sec. 3.2).
struct InnovationSettings {
  InnovationScope scope = InnovationScope::generation;  ///< how long a number is kept
  InnovationKey key = InnovationKey::link;              ///< which new nodes are the same

  void describe(io::SettingsVisitor& visitor);  ///< the table [innovations]
};

/// How two parents make one child (crossover.hpp).
struct CrossoverSettings {
  WeakerGenes weaker_genes = WeakerGenes::all_or_none;  ///< genes that only the weaker parent has
  double weaker_genes_probability = 0.1;  ///< that they are inherited, 0 … 1; 0: the fitter's structure alone
  double enable_probability = 0.25;  ///< that a link disabled in a parent is enabled in the child, 0 … 1
  bool mutate_child = false;         ///< whether the child is mutated, too

  void describe(io::SettingsVisitor& visitor);  ///< the table [crossover]
};

/// Coefficients of the compatibility distance (Stanley & Miikkulainen 2002, eq. 1), each 0 … 1e6: the sum of
/// excess × links newer than all of the other genome's, disjoint × other links that only one has, and weight
/// × Σ |difference of weights| over links of both. Disabled links count like others.
struct DistanceSettings {
  double excess = 1.0;    ///< speciation.excess_coefficient
  double disjoint = 1.0;  ///< speciation.disjoint_coefficient
  double weight = 3.0;    ///< speciation.weight_coefficient
  /// Whether the numbers of links are divided by the larger genome's number of links, and the differences of
  /// weights by the number of links of both (as eq. 1 has it; HyperSharpNEAT does not).
  bool normalised = false;
};

/// Which genomes share a species. The threshold of the distance is steered towards a number of species: the
/// first step out of the target range is a share of the threshold, but at least 0.1; each further one on the
/// same side is 1.05 times the last; after stepping over the range it turns round and is half as long
/// (HyperSharpNEAT). The threshold stays at or above 0.01.
struct SpeciationSettings {
  DistanceSettings distance;  ///< compared with the threshold
  /// Genomes closer than this are of one species, until it first changes, which generation 0 may already do
  /// to come nearer to the targets. 0.01 … 1e9.
  double initial_threshold = 100.0;
  int target_min = 28;  ///< with fewer species the threshold falls, 1 … 1e6; the default is for 300 genomes
  int target_max = 30;  ///< with more it rises, target_min … population.size; likewise
  double first_step_down = 0.01,       ///< first step down as a share of the threshold, 0 … 1
      first_step_up = 0.5;             ///< first step up, likewise (the authors' code; HyperSharpNEAT: 0.01)
  int corrections_per_generation = 1;  ///< most steps in a generation, 0 … 1000; 0: the threshold stays

  void describe(io::SettingsVisitor& visitor);  ///< the table [speciation], that of `distance` included
  /// Sets the targets to the default ones for a population of another size than 300, in the same proportion
  /// to it and at least 1. Reading a config does so before it reads the targets.
  void scale_targets(int population);
};

/// How a species with a single place in the next generation fills it.
enum class LonePlace {
  elite,  ///< by its best by objective: then the population's best is never lost (Morse et al. 2013, sec. 4)
  child   ///< by a mutated child of one survivor, without an elite (the authors' code)
};
/// As configs write them, by LonePlace.
inline constexpr std::array<std::string_view, 2> lone_place_names{"elite", "child"};

/// Who has children, and how many. A species gets places in proportion to its members' mean
/// Fitness::selection.
struct ReproductionSettings {
  double survival = 0.8;  ///< share of a species' members, the best by objective, that may be parents, 0 … 1
  /// Share of a species' places for unchanged copies of its best by objective, 0 … 1, rounded down, but one
  /// at least where `lone_place` allows (Morse et al. 2013, sec. 4).
  double elitism = 0.1;
  LonePlace lone_place = LonePlace::child;  ///< what a species with a single place does with it
  double asexual_probability = 0.5;         ///< that a child has one parent and is mutated, 0 … 1; else two
  double interspecies_probability = 0.01;   ///< that the second parent is of another species, 0 … 1
  /// A species is stagnant when its best objective has not improved for more generations than this, 1 … 1e9.
  int stagnation_generations = 1500;
  double stagnation_factor = 0.01;  ///< factor of a stagnant species' mean selection, 0 … 1

  void describe(io::SettingsVisitor& visitor);  ///< the table [reproduction]
};

/// All settings of NEAT. Their tables are at the top level of a config: population.size,
/// mutation.add_link_share, …
struct Settings {
  PopulationSettings population;      ///< the genomes of a generation
  GenomeSettings genome;              ///< what a genome looks like, at the start and when it grows
  MutationSettings mutation;          ///< what changes a genome
  InnovationSettings innovations;     ///< which structural mutations get the same number
  CrossoverSettings crossover;        ///< how two parents make one child
  SpeciationSettings speciation;      ///< which genomes share a species
  ReproductionSettings reproduction;  ///< offspring, survival, elitism

  void describe(io::SettingsVisitor& visitor);  ///< the tables of all members, at the top level
  /// The rules that join several settings. Throws SettingError: all shares of one roulette are 0, no genome
  /// can ever have a link, target_max is below target_min or above the population's size. Single values are
  /// held to their ranges by describe() alone.
  void validate() const;
};

}  // namespace amble::neat
