#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/search/map_elites.hpp"

// The sphere on which pyribs publishes figures of its searches, by amble's maps (docs/REPERTOIRES.md, "Beside
// pyribs"): a row for each twentieth of the way.

namespace {

using namespace amble;

constexpr int numbers = 100, bins = 100, batch = 540, emitters = 15;
constexpr double step = 0.5;

struct Result {
  double objective = 0.0;
  std::array<float, 2> sums{};
};

/// The linear projection benchmark of Fontaine et al. 2020 (arXiv 1912.02400), as in pyribs: 100 numbers, the
/// best at 2.048 each, 0 … 100; the map is by the sums of either half of them, folded back beyond ±5.12.
Result evaluated(std::span<const neat::LinkGene> links) {
  constexpr double edge = 5.12, best = 0.4 * edge;
  const double worst = (edge + best) * (edge + best) * numbers;
  double squares = 0.0;
  double sums[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < links.size(); ++i) {
    const double x = links[i].weight;
    squares += (x - best) * (x - best);
    sums[2 * i / links.size()] += std::abs(x) > edge ? edge / x : x;
  }
  return {std::max(0.0, 100.0 * (1.0 - squares / worst)),
          {static_cast<float>(sums[0]), static_cast<float>(sums[1])}};
}

struct Search {
  std::string_view name;
  search::Variation variation;
  double line_sigma, learning_rate;
};
constexpr Search searches[] = {
    {"gaussian", search::Variation::line, 0.0, 0.0},       {"line", search::Variation::line, 0.2, 0.0},
    {"cma-mae", search::Variation::cma, 0.0, 0.01},        {"cma-mae-0", search::Variation::cma, 0.0, 0.0},
    {"cma-mae-0.001", search::Variation::cma, 0.0, 0.001}, {"cma-mae-0.1", search::Variation::cma, 0.0, 0.1},
    {"cma-mae-1", search::Variation::cma, 0.0, 1.0},
};

search::MapElites make_search(const Search& kind, int seed) {
  constexpr double reach = 5.12 * numbers / 2;
  search::MapElitesSettings settings;
  settings.descriptors.resize(2);
  for (auto& descriptor : settings.descriptors)
    descriptor = {.leg = {}, .least = -reach, .most = reach, .bins = bins};
  settings.batch = settings.initial = batch;
  settings.variation = kind.variation;
  settings.line = {step, kind.line_sigma};
  settings.cma = {emitters, step, kind.learning_rate, 0.0};
  settings.validate();
  neat::Settings neat;
  neat.genome.weight_limit = 0.001;  // they begin at 0
  return {settings,
          {.neat = neat,
           .inputs = 0,
           .outputs = numbers,
           .recurrent = false,
           .seed = static_cast<std::uint64_t>(seed),
           .behaviour_length = 2}};
}

void run(const Search& kind, int seed, int rounds) {
  auto search = make_search(kind, seed);
  const int every = std::max(1, rounds / 20);
  fmt::print("the sphere by {}, seed {}: rounds, cells filled %, sum of objectives / cells\n", kind.name,
             seed);
  for (int round = 1; round <= rounds; ++round) {
    std::vector<Result> results;
    for (const neat::Genome& genome : search.ask()) results.push_back(evaluated(genome.links));
    std::vector<search::Evaluation> evaluations;
    for (const Result& result : results)
      evaluations.push_back({.objective = result.objective, .behaviour = result.sums});
    search.tell(evaluations);
    search.take_log_growth(0);
    const search::Elites& elites = search.elites();
    if (round % every == 0 || round == rounds)
      fmt::print("{:6} {:7.2f} {:8.3f}\n", round, 100.0 * elites.size() / elites.cells(),
                 elites.objective_sum() / elites.cells());
  }
}

/// A whole number above 0, and nothing else.
std::optional<int> number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view name = argc > 1 ? argv[1] : "";
  const auto* const kind = std::ranges::find_if(searches, [&](const Search& it) { return it.name == name; });
  const std::optional<int> seed = argc > 2 ? number(argv[2]) : 1,
                           rounds = argc > 3 ? number(argv[3]) : 10'000;
  if (kind == std::end(searches) || !seed || !rounds || argc > 4) {
    fmt::print(stderr, "usage: amble_sphere SEARCH [SEED [ROUNDS]]\nsearches:");
    for (const Search& search : searches) fmt::print(stderr, " {}", search.name);
    fmt::print(stderr, "\n");
    return 2;
  }
  run(*kind, *seed, *rounds);
}
