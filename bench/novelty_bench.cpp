#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/random.hpp"
#include "amble/search/novelty.hpp"
#include "bench/benches.hpp"

namespace amble::bench {
namespace {

constexpr std::size_t members = 3000, candidates = 300, samples = 750;
constexpr int neighbours = 15;

using Paths = std::vector<std::vector<float>>;

/// A walk in some direction that sways and drifts; a third falls on the way and stays there.
std::vector<float> some_path(Stream& stream) {
  std::vector<float> path;
  double x = 0.0, y = 0.0, heading = stream.uniform(-3.14, 3.14);
  const double speed = 0.005 * std::abs(stream.normal()), turn = 0.002 * stream.normal();
  const std::size_t fall = stream.chance(0.33) ? stream.below(samples) : samples;
  for (std::size_t i = 0; i < samples; ++i) {
    if (i < fall) {
      x += speed * std::cos(heading) + 0.001 * stream.normal();
      y += speed * std::sin(heading) + 0.001 * stream.normal();
      heading += turn;
    }
    path.push_back(static_cast<float>(x));
    path.push_back(static_cast<float>(y));
  }
  return path;
}

Paths some_paths(std::size_t count) {
  Stream stream(1, Purpose::test, static_cast<std::uint32_t>(count));
  Paths paths;
  while (paths.size() < count) paths.push_back(some_path(stream));
  return paths;
}

std::vector<search::Evaluation> evaluations(const Paths& paths) {
  std::vector<search::Evaluation> evaluations;
  for (const auto& path : paths) evaluations.push_back({.objective = 0.0, .behaviour = path});
  return evaluations;
}

/// What one would write first: every distance in double precision, then the nearest.
std::vector<double> naive_novelties(const Paths& archive, const Paths& generation) {
  std::vector<double> novelties, distances(archive.size());
  for (const auto& candidate : generation) {
    for (std::size_t member = 0; member < archive.size(); ++member) {
      double sum = 0.0;
      for (std::size_t i = 0; i < candidate.size(); ++i) {
        const double difference = static_cast<double>(candidate[i]) - static_cast<double>(archive[member][i]);
        sum += difference * difference;
      }
      distances[member] = sum;
    }
    std::partial_sort(distances.begin(), distances.begin() + neighbours, distances.end());
    double novelty = 0.0;
    for (int k = 0; k < neighbours; ++k) novelty += distances[static_cast<std::size_t>(k)];
    novelties.push_back(novelty);
  }
  return novelties;
}

}  // namespace

void measure_novelty(std::vector<Figure>& figures) {
  const Paths archive = some_paths(members), generation = some_paths(candidates);
  // Filled to its limit by the first generation, the archive stays as it is while it is measured.
  search::NoveltySettings settings;
  settings.neighbours = neighbours;
  settings.first_members = settings.archive_limit = static_cast<int>(members);
  search::NoveltySearch search(settings, 2 * samples);
  search.fitness_of(evaluations(archive));
  AMBLE_CHECK(search.archive().rows() == members, "the archive is full");

  const auto judged = search.fitness_of(evaluations(generation));
  const auto expected = naive_novelties(archive, generation);
  for (std::size_t i = 0; i < candidates; ++i)
    AMBLE_CHECK(std::abs(judged[i].selection - expected[i]) <= 1e-12 * expected[i], "both find the same");

  const double seconds = seconds_per_call([&] { search.fitness_of(evaluations(generation)); });
  const double naive_s = seconds_per_call([&] { naive_novelties(archive, generation); }, 0.3, 3);
  figures.push_back({"novelty_vs_naive", naive_s / seconds, "1", "judging a generation, over plain loops"});
  figures.push_back({"novelty_generation_ms", seconds * 1e3, "ms",
                     "300 candidates, archive of 3,000, behaviours of 1,500 numbers; one core"});
  figures.push_back({"novelty_naive_generation_ms", naive_s * 1e3, "ms", "double precision"});
}

}  // namespace amble::bench
