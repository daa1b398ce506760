#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/search/map_elites.hpp"

// The domains on which libraries of quality diversity publish figures, by amble's maps (docs/REPERTOIRES.md,
// "Beside pyribs"): a row for each fiftieth of the way.

namespace {

using namespace amble;

struct Result {
  double objective = 0.0;
  std::vector<float> behaviour;
};

/// The linear projection benchmark of Fontaine et al. 2020 (arXiv 1912.02400), as in pyribs: 100 numbers, the
/// best at 2.048 each, 0 … 100; the map is by the sums of either half of them, folded back beyond ±5.12.
Result sphere(std::span<const neat::LinkGene> numbers) {
  constexpr double edge = 5.12, best = 0.4 * edge;
  const double worst = (edge + best) * (edge + best) * static_cast<double>(numbers.size());
  double squares = 0.0;
  double sums[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = numbers[i].weight;
    squares += (x - best) * (x - best);
    sums[2 * i / numbers.size()] += std::abs(x) > edge ? edge / x : x;
  }
  return {100.0 * (1.0 - squares / worst), {static_cast<float>(sums[0]), static_cast<float>(sums[1])}};
}

/// A planar arm of twelve links of length 1 (pyribs' tutorial): where its hand is, and how little its angles
/// differ.
Result arm(std::span<const neat::LinkGene> numbers) {
  constexpr double pi = std::numbers::pi;
  const auto count = static_cast<double>(numbers.size());
  double sum = 0.0, squares = 0.0, angle = 0.0, x = 0.0, y = 0.0;
  for (const neat::LinkGene& link : numbers) {
    const double bend = std::clamp(link.weight, -pi, pi);
    sum += bend;
    squares += bend * bend;
    angle += bend;
    x += std::cos(angle);
    y += std::sin(angle);
  }
  return {-(squares / count - sum / count * (sum / count)), {static_cast<float>(x), static_cast<float>(y)}};
}

struct Domain {
  std::string_view name;
  Result (*evaluate)(std::span<const neat::LinkGene>);
  int numbers;
  double reach;  ///< of either descriptor, to both sides
  search::Archive archive;
  int batch, emitters, rounds;
  double step, least_threshold;
};
constexpr Domain domains[] = {
    {"sphere", sphere, 100, 256.0, search::Archive::grid, 540, 15, 10'000, 0.5, 0.0},
    {"arm", arm, 12, 12.0, search::Archive::cvt, 150, 5, 700, 0.1, -1e9},
};

struct Search {
  std::string_view name;
  search::Variation variation;
  double shared, learning_rate;
};
constexpr Search searches[] = {
    {"gaussian", search::Variation::line, 0.0, 0.0},       {"line", search::Variation::line, 0.2, 0.0},
    {"cma-mae", search::Variation::cma, 0.0, 0.01},        {"cma-mae-0", search::Variation::cma, 0.0, 0.0},
    {"cma-mae-0.001", search::Variation::cma, 0.0, 0.001}, {"cma-mae-0.1", search::Variation::cma, 0.0, 0.1},
    {"cma-me", search::Variation::cma, 0.0, 1.0},
};

search::MapElites make_search(const Domain& domain, const Search& kind, std::uint64_t seed) {
  search::MapElitesSettings settings;
  settings.descriptors.resize(2);
  for (auto& descriptor : settings.descriptors)
    descriptor = {.leg = {}, .least = -domain.reach, .most = domain.reach, .bins = 100};
  settings.archive = domain.archive;
  settings.cells = 10'000;
  settings.batch = settings.initial = domain.batch;
  settings.variation = kind.variation;
  settings.line = {domain.step, kind.shared};
  settings.cma = {domain.emitters, domain.step, kind.learning_rate, domain.least_threshold};
  settings.validate();
  neat::Settings neat;
  neat.genome.weight_limit = 0.001;  // they begin at 0
  return {settings,
          {.neat = neat,
           .inputs = 0,
           .outputs = domain.numbers,
           .recurrent = false,
           .seed = seed,
           .behaviour_length = 2}};
}

void run(const Domain& domain, const Search& kind, int seed, int rounds) {
  auto search = make_search(domain, kind, static_cast<std::uint64_t>(seed));
  const int every = std::max(1, rounds / 20);
  fmt::print("{} by {}, seed {}: rounds, cells filled %, sum of objectives / cells\n", domain.name, kind.name,
             seed);
  for (int round = 1; round <= rounds; ++round) {
    std::vector<search::Evaluation> evaluations;
    std::vector<Result> results;
    for (const neat::Genome& genome : search.ask()) results.push_back(domain.evaluate(genome.links));
    for (const Result& result : results)
      evaluations.push_back({.objective = result.objective, .behaviour = result.behaviour});
    search.tell(evaluations);
    search.take_log_growth(0);
    const search::Elites& elites = search.elites();
    if (round % every == 0 || round == rounds)
      fmt::print("{:6} {:7.2f} {:8.3f}\n", round, 100.0 * elites.size() / elites.cells(),
                 elites.objective_sum() / elites.cells());
  }
}

template <typename Rows>
const auto* named(const Rows& rows, std::string_view name) {
  const auto found = std::ranges::find_if(rows, [&](const auto& row) { return row.name == name; });
  return found == std::end(rows) ? nullptr : &*found;
}

int number(std::string_view text, int otherwise) {
  int value = otherwise;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  const Domain* const domain = argc > 2 ? named(domains, argv[1]) : nullptr;
  const Search* const kind = argc > 2 ? named(searches, argv[2]) : nullptr;
  if (domain == nullptr || kind == nullptr) {
    fmt::print(stderr, "usage: amble_domains sphere|arm SEARCH [SEED [ROUNDS]]\nsearches:");
    for (const Search& search : searches) fmt::print(stderr, " {}", search.name);
    fmt::print(stderr, "\n");
    return 2;
  }
  run(*domain, *kind, argc > 3 ? number(argv[3], 1) : 1,
      argc > 4 ? number(argv[4], domain->rounds) : domain->rounds);
}
