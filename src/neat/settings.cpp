#include "amble/neat/settings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "amble/core/error.hpp"

namespace amble::neat {
namespace {

constexpr io::Range probability{0.0, 1.0};
constexpr io::Range share{0.0, 1e6};
constexpr io::Range coefficient{0.0, 1e6};

constexpr std::string_view authors = "the authors' code";
constexpr std::string_view hyper_sharp_neat = "HyperSharpNEAT";
constexpr std::string_view morse_2013 = "Morse et al. 2013, sec. 4";
constexpr std::string_view stanley_2002 = "Stanley & Miikkulainen 2002, sec. 4.1";

}  // namespace

void PopulationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer("size", size, {2, 1e6}, {"genomes per generation", morse_2013});
}

void GenomeSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number(
      "weight_limit", weight_limit, {1e-3, 1e3},
      {"new weights are uniform within ± this, and NEAT keeps them in it (CMA-ES, CMA-MAE and lines between "
       "elites do not)",
       "HyperSharpNEAT: range 3"});
  visitor.number(
      "initial_link_probability", initial_link_probability, probability,
      {"probability of each link from bias and inputs to outputs in generation 0", hyper_sharp_neat});
  visitor.choice("output_activation", output_activation, activation_names,
                 {"activation function of the output nodes", authors});
  visitor.begin("activation_shares", {"roulette for the activation function of a new hidden node"});
  for (std::size_t i = 0; i < activation_names.size(); ++i)
    visitor.number(activation_names[i], activation_shares[i], share, {"share of this function", morse_2013});
  visitor.end();
}

void WeightMutationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("jiggle_limit", jiggle_limit, {0, 1e3},
                 {"jiggling adds a uniform number within ± this to a weight", hyper_sharp_neat});
  visitor.number("jiggle_many_share", jiggle_many_share, share,
                 {"share of jiggling many links", hyper_sharp_neat});
  visitor.number("jiggle_many_probability", jiggle_many_probability, probability,
                 {"probability of each link then (at least one is changed)", hyper_sharp_neat});
  visitor.number("jiggle_few_share", jiggle_few_share, share,
                 {"share of jiggling few links", hyper_sharp_neat});
  visitor.number("jiggle_few_probability", jiggle_few_probability, probability,
                 {"probability of each link then (at least one is changed)", hyper_sharp_neat});
  visitor.number("jiggle_one_share", jiggle_one_share, share,
                 {"share of jiggling one link", hyper_sharp_neat});
  visitor.number("reset_few_share", reset_few_share, share,
                 {"share of drawing few weights anew", hyper_sharp_neat});
  visitor.number("reset_few_probability", reset_few_probability, probability,
                 {"probability of each link then (at least one is changed)", hyper_sharp_neat});
  visitor.number("reset_one_share", reset_one_share, share,
                 {"share of drawing one weight anew", hyper_sharp_neat});
}

void MutationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("weights_share", weights_share, share,
                 {"share of changing weights; one operator is drawn per mutated genome", authors});
  visitor.number("add_link_share", add_link_share, share, {"share of adding a link", morse_2013});
  visitor.number("add_node_share", add_node_share, share,
                 {"share of splitting a link by a new node", morse_2013});
  visitor.number("delete_link_share", delete_link_share, share, {"share of deleting a link", authors});
  visitor.choice("split_link", split_link, split_link_names,
                 {"what becomes of the link that a new node splits",
                  "the authors' code: remove; Stanley & Miikkulainen 2002, sec. 3.1: disable"});
  visitor.table("weights", weights, {"roulette for how weights change"});
}

void InnovationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("scope", scope, innovation_scope_names,
                 {"where the same structural mutation gets the same number: within one generation, or "
                  "whenever it occurs in the run",
                  "the authors' code and Stanley & Miikkulainen 2002, sec. 3.2: generation"});
  visitor.choice("key", key, innovation_key_names,
                 {"when new nodes are the same: if they split the same link (then nodes of one id may differ "
                  "in function), or if they also have the same function",
                  "the authors' code: link"});
}

void CrossoverSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "weaker_genes", weaker_genes, weaker_genes_names,
      {"how genes that only the weaker parent has are inherited: together, or each by its own draw",
       hyper_sharp_neat});
  visitor.number("weaker_genes_probability", weaker_genes_probability, probability,
                 {"probability of inheriting them (0: the child has the fitter parent's structure)",
                  "HyperSharpNEAT; Stanley & Miikkulainen 2002, sec. 3.2: 0"});
  visitor.number("enable_probability", enable_probability, probability,
                 {"probability that a link disabled in either parent is enabled in the child", stanley_2002});
  visitor.flag("mutate_child", mutate_child,
               {"whether a child of two parents is mutated, too", hyper_sharp_neat});
}

void SpeciationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("excess_coefficient", distance.excess, coefficient,
                 {"weight of excess links in the compatibility distance", authors});
  visitor.number("disjoint_coefficient", distance.disjoint, coefficient,
                 {"weight of disjoint links in the compatibility distance", authors});
  visitor.number("weight_coefficient", distance.weight, coefficient,
                 {"weight of weight differences in the compatibility distance", authors});
  visitor.flag(
      "normalised", distance.normalised,
      {"false: the distance is a sum; true: counts are divided by the larger genome's links, and weight "
       "differences averaged",
       "HyperSharpNEAT: false; Stanley & Miikkulainen 2002, eq. 1: true"});
  visitor.number("initial_threshold", initial_threshold, {0.01, 1e9},
                 {"two genomes closer than this are of one species, in generation 0", authors});
  visitor.integer(
      "target_min", target_min, {1, 1e6},
      {"with fewer species than this the threshold falls; where a config leaves it out, in proportion "
       "to population.size",
       "the authors' code (population 300)"});
  visitor.integer(
      "target_max", target_max, {1, 1e6},
      {"with more species than this the threshold rises; where a config leaves it out, in proportion "
       "to population.size",
       "the authors' code (population 300)"});
  visitor.number("first_step_down", first_step_down, probability,
                 {"first step down of the threshold, as a share of it (at least 0.1): each further one is "
                  "1.05 times the "
                  "last, and after stepping over the range half of it, backwards",
                  hyper_sharp_neat});
  visitor.number("first_step_up", first_step_up, probability,
                 {"first step up, likewise", "the authors' code: 0.5; HyperSharpNEAT: 0.01"});
  visitor.integer("corrections_per_generation", corrections_per_generation, {0, 1000},
                  {"steps of the threshold per generation at most (0: it stays as it is)", hyper_sharp_neat});
}

void SpeciationSettings::scale_targets(int population) {
  const SpeciationSettings standard;
  const auto scaled = [population](int target) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(target) * population / 300.0)));
  };
  target_min = scaled(standard.target_min);
  target_max = scaled(standard.target_max);
}

void ReproductionSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number(
      "survival", survival, probability,
      {"share of a species' members, the best by objective, that may be parents (at least one)", authors});
  visitor.number(
      "elitism", elitism, probability,
      {"share of a species' places in the next generation for unchanged copies of its best by objective "
       "(at least one)",
       morse_2013});
  visitor.choice(
      "lone_place", lone_place, lone_place_names,
      {"what a species with a single place does with it: keep its best by objective (then the population's "
       "best is never lost), or a mutated child, without an elite",
       "the authors' code: child; Morse et al. 2013, sec. 4: elite (\"to ensure the objective fitness never "
       "decreases\")"});
  visitor.number("asexual_probability", asexual_probability, probability,
                 {"probability that a child has one parent and is mutated; else it has two", authors});
  visitor.number("interspecies_probability", interspecies_probability, probability,
                 {"probability that the second parent comes from another species", authors});
  visitor.integer(
      "stagnation_generations", stagnation_generations, {1, 1e9},
      {"a species is stagnant when its best objective has not improved for more generations than this",
       authors});
  visitor.number("stagnation_factor", stagnation_factor, probability,
                 {"a stagnant species' mean fitness is multiplied by this", hyper_sharp_neat});
}

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.table("population", population, {"the genomes of one generation"});
  visitor.table("genome", genome, {"what a genome looks like, at the start and when it grows"});
  visitor.table("mutation", mutation, {"roulette of the operators that change a genome"});
  visitor.table("innovations", innovations, {"which structural mutations get the same number"});
  visitor.table("crossover", crossover, {"how two parents make one child"});
  visitor.table("speciation", speciation, {"which genomes share a species"});
  visitor.table("reproduction", reproduction, {"numbers of offspring, survival, elitism"});
}

void Settings::validate() const {
  const auto check = [](bool good, std::string key, auto value, std::string_view expected,
                        std::string other = {}) {
    if (good) return;
    std::vector<std::string> keys{key};
    if (!other.empty()) keys.push_back(std::move(other));
    fail_setting(std::move(keys), "'{}' = {}: expected {}", key, value, expected);
  };
  const double operators =
      mutation.weights_share + mutation.add_link_share + mutation.add_node_share + mutation.delete_link_share;
  check(operators > 0, "mutation.weights_share", mutation.weights_share,
        "more than 0, because all other shares of mutation are 0");
  const WeightMutationSettings& w = mutation.weights;
  check(mutation.weights_share == 0 || w.jiggle_many_share + w.jiggle_few_share + w.jiggle_one_share +
                                               w.reset_few_share + w.reset_one_share >
                                           0,
        "mutation.weights.jiggle_many_share", w.jiggle_many_share,
        "more than 0, because all other shares of mutation.weights are 0");
  const auto& shares = genome.activation_shares;
  check(std::accumulate(shares.begin(), shares.end(), 0.0) > 0, "genome.activation_shares.bipolar_sigmoid",
        shares[0], "more than 0, because the shares of all other functions are 0");
  check(genome.initial_link_probability > 0 || mutation.add_link_share > 0, "mutation.add_link_share",
        mutation.add_link_share, "more than 0, because genome.initial_link_probability is 0",
        "genome.initial_link_probability");
  check(speciation.target_max >= speciation.target_min, "speciation.target_max", speciation.target_max,
        fmt::format("at least speciation.target_min = {}", speciation.target_min), "speciation.target_min");
  check(speciation.target_max <= population.size, "speciation.target_max", speciation.target_max,
        fmt::format("at most population.size = {}", population.size), "population.size");
}

}  // namespace amble::neat
