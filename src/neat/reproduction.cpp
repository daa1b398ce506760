#include "amble/neat/reproduction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/crossover.hpp"
#include "amble/neat/mutation.hpp"
#include "amble/neat/shares.hpp"

namespace amble::neat {
namespace {

/// The members of one species that may be parents.
struct Survivors {
  std::vector<std::size_t> genomes;
  std::vector<double> selection;

  /// The index in these lists of one drawn by roulette.
  std::size_t draw(Stream& stream) const { return roulette(selection, stream); }
  /// The same, but not the one at index `but`; there must be another.
  std::size_t draw_other(std::size_t but, Stream& stream) const {
    std::vector<double> others = selection;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(but));
    const std::size_t drawn = roulette(others, stream);
    return drawn < but ? drawn : drawn + 1;
  }
};

class Breeder {
 public:
  Breeder(const Generation& generation, const Settings& settings, bool recurrent, Innovations& innovations)
      : generation_(generation), settings_(settings), recurrent_(recurrent), innovations_(innovations) {
    for (const Species& species : generation.species) {
      const double share = settings.reproduction.survival * static_cast<double>(species.members.size());
      const auto count = std::max<std::size_t>(1, to_index(std::lround(share)));
      Survivors& survivors = survivors_.emplace_back();
      for (std::size_t i = 0; i < count; ++i) {
        const auto member = to_index(species.members[i]);
        survivors.genomes.push_back(member);
        survivors.selection.push_back(generation.fitness[member].selection);
      }
    }
  }

  /// A mutated copy of one survivor.
  Genome mutant(std::size_t species, Stream& stream) {
    const Survivors& survivors = survivors_[species];
    Genome child = generation_.genomes[survivors.genomes[survivors.draw(stream)]];
    mutate(child, settings_, recurrent_, innovations_, stream);
    return child;
  }

  Genome breed(std::size_t species, Stream& stream) {
    const Survivors& survivors = survivors_[species];
    const std::size_t drawn = survivors.draw(stream);
    const std::size_t parent = survivors.genomes[drawn];
    const std::optional<std::size_t> mate = stream.chance(settings_.reproduction.asexual_probability)
                                                ? std::nullopt
                                                : draw_mate(species, drawn, stream);
    Genome child = mate ? cross(parent, *mate, stream) : generation_.genomes[parent];
    if (!mate || settings_.crossover.mutate_child) mutate(child, settings_, recurrent_, innovations_, stream);
    return child;
  }

 private:
  std::optional<std::size_t> draw_mate(std::size_t species, std::size_t drawn, Stream& stream) const {
    const bool abroad =
        stream.chance(settings_.reproduction.interspecies_probability) && survivors_.size() > 1;
    if (abroad) {
      const std::size_t other = stream.below(static_cast<std::uint32_t>(survivors_.size() - 1));
      const Survivors& foreign = survivors_[other < species ? other : other + 1];
      return foreign.genomes[foreign.draw(stream)];
    }
    const Survivors& own = survivors_[species];
    if (own.genomes.size() == 1) return std::nullopt;
    return own.genomes[own.draw_other(drawn, stream)];
  }

  Genome cross(std::size_t a, std::size_t b, Stream& stream) const {
    const double selection_a = generation_.fitness[a].selection,
                 selection_b = generation_.fitness[b].selection;
    const bool a_is_fitter = selection_a != selection_b ? selection_a > selection_b : stream.chance(0.5);
    const Genome& genome_a = generation_.genomes[a];
    const Genome& genome_b = generation_.genomes[b];
    Genome child = crossover(a_is_fitter ? genome_a : genome_b, a_is_fitter ? genome_b : genome_a,
                             settings_.crossover, recurrent_, stream);
    // With InnovationKey::link parents may differ in a node's function.
    for (NodeGene& node : child.nodes)
      if (const int index = genome_a.index_of(node.id); index >= 0)
        node.activation = genome_a.nodes[to_index(index)].activation;
    return child;
  }

  const Generation& generation_;
  const Settings& settings_;
  bool recurrent_;
  Innovations& innovations_;
  std::vector<Survivors> survivors_;
};

/// The species with the best objective in this generation; of equal ones that of the genome with the lowest
/// index.
std::size_t species_of_the_best(const Generation& generation) {
  const auto best = std::ranges::max_element(generation.fitness, {}, &Fitness::objective);
  const int index = static_cast<int>(best - generation.fitness.begin());
  const auto holds_it = [&](const Species& species) {
    return std::ranges::count(species.members, index) > 0;
  };
  return to_index(std::ranges::find_if(generation.species, holds_it) - generation.species.begin());
}

std::size_t elite_count(std::size_t places, std::size_t members, const ReproductionSettings& settings) {
  if (places == 1 && settings.lone_place == LonePlace::child) return 0;
  // The small addend keeps a share such as 0.29 of 100, which binary numbers put just below 29, at 29.
  const auto share = static_cast<std::size_t>(settings.elitism * static_cast<double>(places) + 1e-9);
  return std::min({std::max<std::size_t>(share, 1), members, places});
}

}  // namespace

std::vector<int> places_per_species(const Generation& generation, const ReproductionSettings& settings) {
  const double largest = std::ranges::max(generation.fitness, {}, &Fitness::selection).selection;
  std::vector<double> shares;
  for (const Species& species : generation.species) {
    // In units of the largest selection, so that no sum overflows.
    double sum = 0.0;
    for (const int member : species.members)
      if (largest > 0.0) sum += generation.fitness[to_index(member)].selection / largest;
    const bool stagnant = species.generations_without_improvement > settings.stagnation_generations;
    const double mean = sum / static_cast<double>(species.members.size());
    shares.push_back(stagnant ? mean * settings.stagnation_factor : mean);
  }
  const auto total = static_cast<int>(generation.genomes.size());
  if (settings.lone_place == LonePlace::child) return allot_places(shares, total, std::nullopt);
  return allot_places(shares, total, species_of_the_best(generation));
}

std::vector<Genome> reproduce(const Generation& generation, const Settings& settings, bool recurrent,
                              Innovations& innovations, std::uint64_t seed, std::uint32_t number) {
  const std::vector<int> places = places_per_species(generation, settings.reproduction);
  innovations.begin_generation();
  Breeder breeder(generation, settings, recurrent, innovations);
  std::vector<Genome> children;
  for (std::size_t s = 0; s < generation.species.size(); ++s) {
    const std::vector<int>& members = generation.species[s].members;
    const auto own_places = to_index(places[s]);
    const std::size_t elites = elite_count(own_places, members.size(), settings.reproduction);
    for (std::size_t i = 0; i < elites; ++i) children.push_back(generation.genomes[to_index(members[i])]);
    for (std::size_t i = elites; i < own_places; ++i) {
      Stream stream(seed, Purpose::reproduction, number, static_cast<std::uint32_t>(children.size()));
      children.push_back(elites == 0 ? breeder.mutant(s, stream) : breeder.breed(s, stream));
    }
  }
  return children;
}

}  // namespace amble::neat
