#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/search/map_elites.hpp"

// The two domains on which pyribs publishes figures of its searches, by amble's maps (docs/REPERTOIRES.md,
// "Beside pyribs"): a row for each twentieth of the way. A solution is the weights of a genome's links.

namespace {

using namespace amble;

struct Result {
  double objective = 0.0;
  std::array<float, 2> measures{};
};

/// The linear projection benchmark of Fontaine et al. 2020 (arXiv 1912.02400), as in pyribs: 100 numbers, the
/// best at 2.048 each, 0 … 100; the map is by the sums of either half of them, folded back beyond ±5.12.
Result on_sphere(std::span<const neat::LinkGene> links) {
  constexpr double edge = 5.12, best = 0.4 * edge;
  const double worst = (edge + best) * (edge + best) * static_cast<double>(links.size());
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

/// A planar arm of links of length 1, as in pyribs: the map is by where its hand is, and the objective says
/// how little the angles of its joints differ: 100 less ten times their variance, in rad²; 0 is the least.
Result on_arm(std::span<const neat::LinkGene> links) {
  const auto joints = static_cast<double>(links.size());
  double mean = 0.0, variance = 0.0, angle = 0.0, x = 0.0, y = 0.0;
  for (const neat::LinkGene& link : links) mean += link.weight / joints;
  for (const neat::LinkGene& link : links) {
    variance += (link.weight - mean) * (link.weight - mean) / joints;
    angle += link.weight;
    x += std::cos(angle);
    y += std::sin(angle);
  }
  return {std::max(0.0, 100.0 - 10.0 * variance), {static_cast<float>(x), static_cast<float>(y)}};
}

struct Domain {
  std::string_view name;
  Result (*evaluated)(std::span<const neat::LinkGene>);
  int numbers;   ///< of a solution
  double reach;  ///< the map's ranges, ±
  search::Archive archive;
  int batch, emitters;
  double step;
  int rounds;
};
// As pyribs has them: examples/sphere.py and tutorials/arm_repertoire.ipynb.
constexpr Domain domains[] = {
    {"sphere", on_sphere, 100, 5.12 * 100 / 2, search::Archive::grid, 540, 15, 0.5, 10'000},
    {"arm", on_arm, 12, 12.0, search::Archive::cvt, 150, 5, 0.1, 700},
};

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

search::MapElites make_search(const Domain& domain, const Search& kind, int seed) {
  search::MapElitesSettings settings;
  settings.descriptors.resize(2);
  for (auto& descriptor : settings.descriptors)
    descriptor = {.leg = {}, .least = -domain.reach, .most = domain.reach, .bins = 100};
  settings.archive = domain.archive;
  settings.cells = 10'000;
  settings.batch = settings.initial = domain.batch;
  settings.variation = kind.variation;
  settings.line = {domain.step, kind.line_sigma};
  settings.cma = {domain.emitters, domain.step, kind.learning_rate, 0.0};
  settings.validate();
  neat::Settings neat;
  neat.genome.weight_limit = 0.001;  // they begin at 0
  return {settings,
          {.neat = neat,
           .inputs = 0,
           .outputs = domain.numbers,
           .recurrent = false,
           .seed = static_cast<std::uint64_t>(seed),
           .behaviour_length = 2}};
}

void run(const Domain& domain, const Search& kind, int seed, int rounds) {
  auto search = make_search(domain, kind, seed);
  const int every = std::max(1, rounds / 20);
  fmt::print("the {} by {}, seed {}: rounds, cells filled %, sum of objectives / cells, best objective\n",
             domain.name, kind.name, seed);
  double best = 0.0;
  for (int round = 1; round <= rounds; ++round) {
    std::vector<Result> results;
    for (const neat::Genome& genome : search.ask()) results.push_back(domain.evaluated(genome.links));
    std::vector<search::Evaluation> evaluations;
    for (const Result& result : results) {
      best = std::max(best, result.objective);
      evaluations.push_back({.objective = result.objective, .behaviour = result.measures});
    }
    search.tell(evaluations);
    search.take_log_growth(0);
    const search::Elites& elites = search.elites();
    if (round % every == 0 || round == rounds)
      fmt::print("{:6} {:7.2f} {:8.3f} {:10.5f}\n", round, 100.0 * elites.size() / elites.cells(),
                 elites.objective_sum() / elites.cells(), best);
  }
}

/// A whole number above 0, and nothing else.
std::optional<int> number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

template <class Named, std::size_t count>
const Named* named(const Named (&all)[count], std::string_view name) {
  const auto* const found = std::ranges::find(all, name, &Named::name);
  return found == std::end(all) ? nullptr : found;
}

}  // namespace

int main(int argc, char** argv) {
  const Domain* const domain = named(domains, argc > 1 ? argv[1] : "");
  const Search* const kind = named(searches, argc > 2 ? argv[2] : "");
  const std::optional<int> seed = argc > 3 ? number(argv[3]) : 1, rounds = argc > 4 ? number(argv[4]) : 0;
  if (domain == nullptr || kind == nullptr || !seed || !rounds || argc > 5) {
    fmt::print(stderr, "usage: amble_domains DOMAIN SEARCH [SEED [ROUNDS]]\ndomains:");
    for (const Domain& one : domains) fmt::print(stderr, " {}", one.name);
    fmt::print(stderr, "\nsearches:");
    for (const Search& one : searches) fmt::print(stderr, " {}", one.name);
    fmt::print(stderr, "\n");
    return 2;
  }
  run(*domain, *kind, *seed, *rounds > 0 ? *rounds : domain->rounds);
}
