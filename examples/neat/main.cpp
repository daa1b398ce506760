// NEAT by itself, on the problems of Stanley & Miikkulainen 2002: how many genomes are evaluated until one
// solves it. Links neat and cppn alone.
//   neat_alone xor|dpv|dpnv [SEEDS [FIRST_SEED]]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "amble/cppn/network.hpp"
#include "amble/neat/population.hpp"
#include "poles.hpp"
#include "recurrent.hpp"

namespace {

using namespace amble;

struct Result {
  double fitness = 0.0;
  bool solves = false;
};

struct Benchmark {
  const char* name;
  const char* published;  // mean evaluations, Stanley & Miikkulainen 2002, tables 1 to 3
  int inputs, population, generations;
  bool recurrent;
  std::function<Result(const neat::Genome&)> evaluate;
  /// Whether a genome solves the problem for good. Of each generation one takes it: the best that has not
  /// taken it.
  std::function<bool(const neat::Genome&)> final_test;
};

/// Sec. 4.1: (4 − Σ |error|)²; solved if all four outputs are on the right side of a half.
Result exclusive_or(const neat::Genome& genome) {
  cppn::Points cases(2, 4);
  for (int i = 0; i < 4; ++i) {
    cases.set(i, 0, static_cast<float>(i & 1));
    cases.set(i, 1, static_cast<float>(i >> 1));
  }
  std::vector<float> outputs(cases.capacity());
  cppn::Network(genome, {.recurrent = false}).evaluate(cases, outputs);
  Result result{.fitness = 4.0, .solves = true};
  for (int i = 0; i < 4; ++i) {
    const double target = (i & 1) != (i >> 1) ? 1.0 : 0.0, output = 0.5 + 0.5 * outputs[i];
    result.fitness -= std::abs(output - target);
    result.solves = result.solves && std::abs(output - target) < 0.5;
  }
  result.fitness *= result.fitness;
  return result;
}

constexpr std::array<double, 6> scales{4.8, 2.0, 0.52, 2.0, 0.52, 2.0};

/// Steps until something falls, `most` at most. `senses`: which of the state's numbers the network gets.
/// `wiggle`: of the last hundred steps, Σ |cart's position| + |speed| + |first angle| + |its speed|.
template <std::size_t count>
int balance(Recurrent& network, const std::array<int, count>& senses, int most, Poles poles = {},
            double* wiggle = nullptr) {
  network.forget();
  std::array<double, 100> last{};
  std::array<double, count> inputs;
  int step = 0;
  for (; step < most && poles.stands(); ++step) {
    for (std::size_t i = 0; i < count; ++i) inputs[i] = poles.state[senses[i]] / scales[senses[i]];
    poles.step(network.step(inputs));
    double& sum = last[step % 100] = 0.0;
    for (int i = 0; i < 4; ++i) sum += std::abs(poles.state[i]);
  }
  if (wiggle != nullptr) {
    *wiggle = 0.0;
    for (const double sum : last) *wiggle += sum;
  }
  return step;
}

constexpr std::array<int, 6> with_speeds{0, 1, 2, 3, 4, 5};
constexpr std::array<int, 3> without_speeds{0, 2, 4};
constexpr int long_run = 100000;

/// Sec. 4.3: the time that both poles stand.
Result poles_with_speeds(const neat::Genome& genome) {
  Recurrent network(genome);
  const int steps = balance(network, with_speeds, long_run);
  return {.fitness = steps / 1000.0, .solves = steps == long_run};
}

/// Sec. 4.4, after Gruau et al. 1996: 0.1 × time + 0.9 × quietness at the end of 1000 steps.
Result poles_without_speeds(const neat::Genome& genome) {
  Recurrent network(genome);
  double wiggle = 0.0;
  const int steps = balance(network, without_speeds, 1000, {}, &wiggle);
  return {.fitness = 0.1 * steps / 1000.0 + (steps < 100 ? 0.0 : 0.9 * 0.75 / wiggle)};
}

/// Stands for 100,000 steps, and for 1000 from at least 200 of 625 other starts.
bool generalises(const neat::Genome& genome) {
  Recurrent network(genome);
  if (balance(network, without_speeds, long_run) < long_run) return false;
  constexpr std::array<double, 5> places{0.05, 0.25, 0.5, 0.75, 0.95};
  int stood = 0;
  for (const double a : places)
    for (const double b : places)
      for (const double c : places)
        for (const double d : places) {
          Poles start;
          start.state = {
              (2 * a - 1) * 2.16, (2 * b - 1) * 1.35, (2 * c - 1) * 0.0628, (2 * d - 1) * 0.15, 0.0, 0.0};
          stood += balance(network, without_speeds, 1000, start) == 1000;
        }
  return stood >= 200;
}

/// The paper's, where amble has them; the rest is amble's default.
neat::Settings settings_of(const Benchmark& benchmark) {
  const bool large = benchmark.population >= 1000;
  constexpr double steepness = 4.9;  // of the paper's nodes, amble's being 1: weights are so much larger
  neat::Settings s;
  s.population.size = benchmark.population;
  s.genome.weight_limit = 3.0 * steepness;
  s.genome.activation_shares = {1, 0, 0, 0};
  s.mutation = {.weights_share = 0.8,
                .add_link_share = large ? 0.3 : 0.05,
                .add_node_share = 0.03,
                .split_link = neat::SplitLink::disable,
                .weights = {.jiggle_limit = 2.5 * steepness,
                            .jiggle_many_share = 0.9,
                            .jiggle_many_probability = 1.0,
                            .jiggle_few_share = 0.0,
                            .jiggle_one_share = 0.0,
                            .reset_few_share = 0.1,
                            .reset_few_probability = 0.1,
                            .reset_one_share = 0.0}};
  s.crossover = {.weaker_genes_probability = 0.0, .enable_probability = 0.25, .mutate_child = true};
  s.speciation.distance = {.excess = 1.0,
                           .disjoint = 1.0,
                           .weight = large ? 3.0 / steepness : 0.4 / steepness,
                           .normalised = true};
  s.speciation.initial_threshold = large ? 4.0 : 3.0;
  s.speciation.scale_targets(benchmark.population);
  s.reproduction = {.survival = 0.2,
                    .lone_place = neat::LonePlace::elite,
                    .asexual_probability = 0.25,
                    .interspecies_probability = 0.001,
                    .stagnation_generations = 15};
  s.validate();
  return s;
}

/// The best by objective that is not among the `tested`, else the best, which joins them. The best alone
/// would be tested again and again where it stands quietly but not long.
const neat::Genome& to_test(std::span<const neat::Genome> genomes, const std::vector<neat::Fitness>& fitness,
                            std::vector<neat::Genome>& tested) {
  std::vector<std::size_t> order(genomes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return fitness[i].objective; });
  const auto first = std::ranges::find_if(
      order, [&](std::size_t i) { return std::ranges::find(tested, genomes[i]) == tested.end(); });
  return tested.emplace_back(genomes[first == order.end() ? order.front() : *first]);
}

/// Genomes evaluated until one solves it, whole generations; 0 if none did.
int evaluations_to_solve(const Benchmark& benchmark, std::uint64_t seed) {
  neat::Population population(settings_of(benchmark), benchmark.inputs, 1, benchmark.recurrent, seed);
  std::vector<neat::Genome> tested;
  for (int generation = 1; generation <= benchmark.generations; ++generation) {
    std::vector<neat::Fitness> fitness;
    bool solved = false;
    for (const neat::Genome& genome : population.genomes()) {
      const Result result = benchmark.evaluate(genome);
      solved = solved || result.solves;
      fitness.push_back({.selection = result.fitness, .objective = result.fitness});
    }
    if (solved ||
        (benchmark.final_test && benchmark.final_test(to_test(population.genomes(), fitness, tested))))
      return generation * benchmark.population;
    population.advance(fitness);
  }
  return 0;
}

const Benchmark benchmarks[] = {{"xor", "4,755", 2, 150, 500, false, exclusive_or, {}},
                                {"dpv", "3,600", 6, 150, 500, true, poles_with_speeds, {}},
                                {"dpnv", "33,184", 3, 1000, 200, true, poles_without_speeds, generalises}};

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  const auto benchmark = std::ranges::find(benchmarks, name, &Benchmark::name);
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 100, first = argc > 3 ? std::atoi(argv[3]) : 1;
  if (benchmark == std::end(benchmarks) || seeds < 1) {
    std::fprintf(stderr, "usage: neat_alone xor|dpv|dpnv [SEEDS [FIRST_SEED]]\n");
    return 2;
  }
  std::vector<double> evaluations;
  for (int seed = first; seed < first + seeds; ++seed)
    if (const int count = evaluations_to_solve(*benchmark, static_cast<std::uint64_t>(seed)); count > 0)
      evaluations.push_back(count);
  std::ranges::sort(evaluations);
  double sum = 0.0;
  for (const double count : evaluations) sum += count;
  const std::size_t solved = evaluations.size();
  std::printf(
      "%s: %zu of %d runs solve it; evaluations: mean %.0f, median %.0f, least %.0f, most %.0f (published "
      "mean: %s)\n",
      benchmark->name, solved, seeds, solved ? sum / static_cast<double>(solved) : 0.0,
      solved ? evaluations[solved / 2] : 0.0, solved ? evaluations.front() : 0.0,
      solved ? evaluations.back() : 0.0, benchmark->published);
  return solved == static_cast<std::size_t>(seeds) ? 0 : 1;
}
