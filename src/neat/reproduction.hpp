#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "amble/neat/fitness.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/settings.hpp"
#include "amble/neat/speciation.hpp"

namespace amble::neat {

/// A generation that was evaluated; `species` as Speciation::record() leaves them.
struct Generation {
  std::span<const Genome> genomes;
  std::span<const Fitness> fitness;
  std::span<const Species> species;
};

/// How many places each species gets in the next generation: in proportion to its members' mean selection
/// (the fitness sharing of Stanley & Miikkulainen 2002, sec. 3.3), that of a stagnant species multiplied by
/// stagnation_factor. With LonePlace::elite the species with the best objective gets at least one.
std::vector<int> places_per_species(const Generation& generation, const ReproductionSettings& settings);

/// Breeds as many genomes as there were, species by species. A species' first children are copies of its
/// elites: the best by objective, elitism × places of them, rounded down, at least one and at most all
/// members. With LonePlace::elite the best objective therefore never decreases as long as the same genome
/// earns the same objective. With LonePlace::child a species of one place has no elite but a mutated child of
/// one survivor, and the best can be lost (the authors' code).
///
/// The others are bred from its survivors: survival × members, rounded to the nearest, the best by objective,
/// at least one. Parents are drawn by roulette on selection. The second parent is another survivor of the
/// same species, or with interspecies_probability a survivor of another species, each species equally likely.
/// The parent with the larger selection is the fitter of two; if they are equal, it is drawn at random.
/// Where they differ in a node's function the child has that of the parent drawn first (the authors' code). A
/// species of one survivor has no second parent: the child then has one and is mutated.
///
/// Child i of generation `number` takes its random numbers from Stream(seed, Purpose::reproduction, number,
/// i) alone.
std::vector<Genome> reproduce(const Generation& generation, const Settings& settings, bool recurrent,
                              Innovations& innovations, std::uint64_t seed, std::uint32_t number);

}  // namespace amble::neat
