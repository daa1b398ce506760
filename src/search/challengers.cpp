#include "amble/search/challengers.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace amble::search {
namespace {

// The deviation of a descriptor's value between trials of a genome that little is known of, in units of its
// range, and how many evaluations that counts for. Duty factors of the quadruped's elites: 0.15 to 0.19.
constexpr double usual_deviation = 0.16, usual_evaluations = 2.0;
// Whether a genome stays is judged by the mean over so many trials.
constexpr double judging_trials = 20.0;

void save(const Challenger& challenger, io::BinaryWriter& writer) {
  const Elite& elite = challenger.elite;
  writer.put(elite.cell);
  writer.put(elite.round);
  writer.put(elite.candidate);
  writer.put(elite.evaluations);
  writer.put(elite.objective);
  writer.put(elite.spread);
  writer.put_text(elite.genome);
  writer.put_span(std::span<const float>(challenger.descriptor));
  writer.put(challenger.parent.cell);
  writer.put(challenger.parent.round);
  writer.put(challenger.parent.candidate);
}

Challenger load(io::BinaryReader& reader, std::uint32_t cells, std::size_t dimensions) {
  Challenger challenger;
  Elite& elite = challenger.elite;
  elite.cell = reader.get<std::uint32_t>();
  elite.round = reader.get<std::uint32_t>();
  elite.candidate = reader.get<std::uint32_t>();
  elite.evaluations = reader.get<std::uint32_t>();
  elite.objective = reader.get<double>();
  elite.spread = reader.get<double>();
  elite.genome = reader.get_text();
  challenger.descriptor = reader.get_vector<float>();
  challenger.parent.cell = reader.get<std::uint32_t>();
  challenger.parent.round = reader.get<std::uint32_t>();
  challenger.parent.candidate = reader.get<std::uint32_t>();
  if (elite.cell >= cells || elite.evaluations == 0) reader.bad("a challenger of no cell or no evaluation");
  if (!std::isfinite(elite.objective)) reader.bad("an objective is not finite");
  if (!(elite.spread >= 0.0 && std::isfinite(elite.spread))) reader.bad("a spread below 0");
  if (challenger.descriptor.size() != dimensions) reader.bad("a descriptor of another length");
  for (const float value : challenger.descriptor)
    if (!std::isfinite(value)) reader.bad("a descriptor is not finite");
  if (challenger.parent.cell >= cells && challenger.parent.cell != Elites::none)
    reader.bad("a parent of no cell");
  return challenger;
}

}  // namespace

double staying_probability(const Cells& cells, const Elite& elite, std::span<const float> descriptor) {
  const double evaluations = elite.evaluations;
  const double variance = (usual_evaluations * usual_deviation * usual_deviation + elite.spread) /
                          (usual_evaluations + evaluations - 1.0);
  return cells.share_inside(descriptor, std::sqrt(variance * (1.0 / evaluations + 1.0 / judging_trials)));
}

double worth(const Cells& cells, const Elite& elite, std::span<const float> descriptor) {
  return elite.objective * staying_probability(cells, elite, descriptor);
}

Selected most_promising(std::vector<Challenger> challengers, std::size_t most, const Cells& cells,
                        const Elites& elites) {
  // Those that have been tried again first, then the largest gain first, of equal ones the first.
  std::vector<std::tuple<bool, double, std::size_t>> ranks;
  for (std::size_t i = 0; i < challengers.size(); ++i) {
    const auto& [elite, descriptor, parent] = challengers[i];
    const std::uint32_t there = elites.in(elite.cell);
    const double ahead = elite.objective - (there == Elites::none ? 0.0 : elites[there].objective);
    ranks.emplace_back(elite.evaluations == 1, -ahead * staying_probability(cells, elite, descriptor), i);
  }
  std::ranges::sort(ranks);
  std::set<std::uint32_t> taken;
  std::vector<bool> kept(challengers.size());
  std::size_t count = 0;
  for (const auto& [is_new, loss, i] : ranks)
    if (count < most && taken.insert(challengers[i].elite.cell).second) {
      kept[i] = true;
      ++count;
    }
  Selected selected;
  selected.promising.reserve(count);
  for (std::size_t i = 0; i < challengers.size(); ++i)
    if (kept[i])
      selected.promising.push_back(std::move(challengers[i]));
    else
      selected.parents_of_dropped.push_back(challengers[i].parent);
  return selected;
}

void save_challengers(std::span<const Challenger> challengers, io::BinaryWriter& writer) {
  writer.put(static_cast<std::uint32_t>(challengers.size()));
  for (const Challenger& challenger : challengers) save(challenger, writer);
}

std::vector<Challenger> load_challengers(io::BinaryReader& reader, std::size_t most, std::uint32_t cells,
                                         std::size_t dimensions) {
  const auto count = reader.get<std::uint32_t>();
  if (count > most) reader.bad("more challengers than a batch has candidates");
  std::vector<Challenger> challengers;
  for (std::uint32_t i = 0; i < count; ++i) challengers.push_back(load(reader, cells, dimensions));
  return challengers;
}

}  // namespace amble::search
