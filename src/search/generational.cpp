#include "amble/search/generational.hpp"

#include <cmath>
#include <utility>

#include "amble/core/check.hpp"

namespace amble::search {

GenerationalSearch::GenerationalSearch(neat::Population population, std::unique_ptr<Criterion> criterion)
    : population_(std::move(population)), criterion_(std::move(criterion)) {}

void GenerationalSearch::tell(std::span<const Evaluation> evaluations) {
  AMBLE_CHECK(evaluations.size() == population_.genomes().size(), "one evaluation per candidate");
  statistics_ = population_.statistics();
  population_.advance(criterion_->fitness_of(evaluations));
}

std::vector<Metric> GenerationalSearch::metrics() const {
  std::vector<Metric> metrics{{"species", static_cast<double>(statistics_.species)},
                              {"threshold", statistics_.compatibility_threshold},
                              {"mean_hidden", statistics_.mean_hidden},
                              {"mean_links", statistics_.mean_links}};
  const auto more = criterion_->metrics();
  metrics.insert(metrics.end(), more.begin(), more.end());
  return metrics;
}

void GenerationalSearch::save(io::BinaryWriter& writer) const {
  population_.save(writer);
  criterion_->save(writer);
}

void GenerationalSearch::load(io::BinaryReader& reader) {
  population_.load(reader);
  criterion_->load(reader);
}

std::vector<std::string> GenerationalSearch::logs() const {
  if (!criterion_->has_archive()) return {};
  return {"archive.bin"};
}

std::string GenerationalSearch::take_log_growth(std::size_t i) {
  AMBLE_CHECK(i < logs().size(), "the archive is the only log");
  return criterion_->take_archive_growth();
}

std::uint64_t GenerationalSearch::restore_log(std::size_t i, io::InputFile& file, const std::string& what) {
  AMBLE_CHECK(i < logs().size(), "the archive is the only log");
  return criterion_->restore_archive(file, what);
}

std::vector<neat::Fitness> ObjectiveSearch::fitness_of(std::span<const Evaluation> generation) {
  std::vector<neat::Fitness> fitness;
  fitness.reserve(generation.size());
  for (const Evaluation& evaluation : generation) {
    AMBLE_CHECK(std::isfinite(evaluation.objective) && evaluation.objective >= 0.0,
                "objectives are finite and >= 0");
    fitness.push_back({.selection = evaluation.objective, .objective = evaluation.objective});
  }
  return fitness;
}

}  // namespace amble::search
