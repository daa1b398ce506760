#include "amble/search/cma_es.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/search/weights.hpp"

namespace amble::search {
namespace {

/// Positions of the evaluations, the best first.
std::vector<std::size_t> ranked(std::span<const Evaluation> evaluations) {
  std::vector<std::size_t> order(evaluations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (evaluations[a].viable != evaluations[b].viable) return evaluations[a].viable;
    return evaluations[a].objective > evaluations[b].objective;
  });
  return order;
}

}  // namespace

void CmaEsSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("step", step, {1e-9, 1e3}, {"standard deviation of each weight in the first round"});
  visitor.number("least_step", least_step, {0.0, 1e3},
                 {"when no weight has a larger standard deviation, the search begins again elsewhere"});
}

CmaEs::CmaEs(const CmaEsSettings& settings, const SearchSpace& space)
    : settings_(settings),
      neat_(space.neat),
      inputs_(space.inputs),
      outputs_(space.outputs),
      seed_(space.seed),
      distribution_(new_distribution(0)) {
  sample();
}

neat::Genome CmaEs::initial_genome(int start) const {
  neat::GenomeSettings all_linked = neat_.genome;
  all_linked.initial_link_probability = 1.0;
  neat::Innovations innovations(inputs_, outputs_, neat_.innovations);
  Stream stream(seed_, Purpose::cma_es, 0, static_cast<std::uint32_t>(start));
  return neat::initial_genome(all_linked, inputs_, outputs_, innovations, stream);
}

CovarianceAdaptation CmaEs::new_distribution(int start) const {
  if (neat_.population.size < least_cma_es_candidates)
    fail_setting({"population.size"}, "population.size = {}: CMA-ES needs at least {} candidates",
                 neat_.population.size, least_cma_es_candidates);
  return {weights_of(initial_genome(start)), settings_.step, neat_.population.size};
}

/// The candidates of a round follow from the distribution, the round and the seed.
void CmaEs::sample() {
  candidates_.assign(to_index(neat_.population.size), initial_genome(0));
  std::vector<double> normal(to_index(distribution_.dimensions()));
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    Stream stream(seed_, Purpose::cma_es, static_cast<std::uint32_t>(round_ + 1),
                  static_cast<std::uint32_t>(i));
    for (double& number : normal) number = stream.normal();
    set_weights(candidates_[i], distribution_.sample(normal));
  }
}

void CmaEs::tell(std::span<const Evaluation> evaluations) {
  AMBLE_CHECK(evaluations.size() == candidates_.size(), "an evaluation of each candidate");
  std::vector<std::vector<double>> best_first;
  for (const std::size_t i : ranked(evaluations)) {
    if (static_cast<int>(best_first.size()) == distribution_.parents()) break;
    best_first.push_back(weights_of(candidates_[i]));
  }
  distribution_.update(best_first);
  if (is_over(evaluations)) distribution_ = new_distribution(++restarts_);
  ++round_;
  sample();
}

bool CmaEs::is_over(std::span<const Evaluation> evaluations) const {
  const double widest = distribution_.widest();
  if (!distribution_.sound() || widest <= settings_.least_step || widest > most_growth * settings_.step)
    return true;
  const auto is_other = [](const Evaluation& a, const Evaluation& b) {
    return a.viable != b.viable || (a.viable && a.objective != b.objective);
  };
  return std::ranges::adjacent_find(evaluations, is_other) == evaluations.end();
}

std::vector<Metric> CmaEs::metrics() const {
  return {{"cma_step", distribution_.step()},
          {"cma_widest", distribution_.widest()},
          {"cma_restarts", static_cast<double>(restarts_)}};
}

void CmaEs::save(io::BinaryWriter& writer) const {
  writer.put(round_);
  writer.put(restarts_);
  distribution_.save(writer);
}

void CmaEs::load(io::BinaryReader& reader) {
  round_ = reader.get<int>();
  restarts_ = reader.get<int>();
  distribution_.load(reader);
  sample();
}

}  // namespace amble::search
