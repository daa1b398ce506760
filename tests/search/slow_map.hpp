#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/search/map_elites.hpp"

namespace amble::search::map_test {

inline constexpr int dimensions = 2, bins = 6;

inline MapElitesSettings small_map() {
  MapElitesSettings settings;
  settings.descriptors.resize(dimensions);
  for (auto& descriptor : settings.descriptors) descriptor.bins = bins;
  settings.batch = 40;
  settings.initial = 70;
  settings.reevaluate_share = 0.25;
  settings.pool.size = 20;  // less than a batch
  return settings;
}

/// A result of a genome in a round: its place depends on its weights, and on the luck of the round.
struct Result {
  double objective = 0.0;
  std::vector<float> descriptor;
  bool viable = true;
};

inline Result result_of(const neat::Genome& genome, int round, std::size_t candidate) {
  Stream luck(5, Purpose::test, static_cast<std::uint32_t>(round), static_cast<std::uint32_t>(candidate));
  Result result;
  result.descriptor.assign(dimensions, 0.0f);
  for (std::size_t i = 0; i < genome.links.size(); ++i)
    result.descriptor[i % dimensions] += static_cast<float>(std::abs(genome.links[i].weight) / 4.0);
  for (float& value : result.descriptor) value += static_cast<float>(luck.uniform(-0.1, 0.1));
  // In steps, so that some are equal.
  double weights = 0.0;
  for (const auto& link : genome.links) weights += link.weight;
  result.objective = std::floor(2.0 * luck.uniform()) + static_cast<double>(genome.links.size()) +
                     std::floor(std::abs(4.0 * weights));
  result.viable = !luck.chance(0.03);
  return result;
}

/// The rules of the map once more, by looking at everything.
class SlowMap {
 public:
  struct Entry {
    double objective = 0.0;
    std::vector<float> descriptor;
    std::uint32_t evaluations = 1;
    int last = 0;  ///< when it was last evaluated
    neat::Genome genome;
    double spread = 0.0;
  };

  explicit SlowMap(const MapElitesSettings& settings) : settings_(settings), cells_(make_cells(settings)) {}

  std::uint32_t cell_of(const std::vector<float>& descriptor) const {
    std::uint32_t cell = 0;
    for (const float value : descriptor)
      cell = cell * bins + static_cast<std::uint32_t>(
                               std::min(bins - 1.0, std::max(0.0, std::floor(value * double{bins}))));
    return cell;
  }

  /// The cells to be evaluated again.
  std::vector<std::uint32_t> again(std::size_t count) const {
    std::vector<std::tuple<std::uint32_t, int, std::uint32_t>> all;
    for (const auto& [cell, entry] : entries) all.emplace_back(entry.evaluations, entry.last, cell);
    std::ranges::sort(all);
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < std::min(count, all.size()); ++i) cells.push_back(std::get<2>(all[i]));
    return cells;
  }

  void enter(const neat::Genome& genome, const Result& result) {
    if (result.viable) decide({result.objective, result.descriptor, 1, 0, genome});
  }

  /// Takes the first challenger of the round before that has not been tried again.
  void challenge_again(const Result& result) {
    Entry entry = challengers.front();
    challengers.erase(challengers.begin());
    if (!result.viable) return;
    add(entry, result);
    decide(std::move(entry));
  }

  void evaluate_again(std::uint32_t cell, const neat::Genome& genome, const Result& result) {
    const auto found = entries.find(cell);
    if (found == entries.end() || !(found->second.genome == genome)) return;
    Entry entry = found->second;
    entries.erase(found);
    if (!result.viable) return;
    add(entry, result);
    if (cell_of(entry.descriptor) == cell || prevails(entry)) put(std::move(entry));
  }

  /// At the end of a round.
  void drop_challengers(std::size_t most) {
    const auto comes_before = [this](const Entry& a, const Entry& b) {
      if ((a.evaluations > 1) != (b.evaluations > 1)) return a.evaluations > 1;
      return gain(a) > gain(b);
    };
    for (std::size_t i = 0; i < challengers.size(); ++i)
      for (std::size_t j = i + 1; j < challengers.size();) {
        const bool are_rivals = cell_of(challengers[i].descriptor) == cell_of(challengers[j].descriptor);
        if (are_rivals && comes_before(challengers[j], challengers[i])) {
          challengers.erase(challengers.begin() + static_cast<std::ptrdiff_t>(i));
          j = i + 1;
        } else if (are_rivals) {
          challengers.erase(challengers.begin() + static_cast<std::ptrdiff_t>(j));
        } else {
          ++j;
        }
      }
    while (challengers.size() > most) {
      auto last = challengers.begin();
      for (auto it = challengers.begin(); it != challengers.end(); ++it)
        if (!comes_before(*it, *last)) last = it;
      challengers.erase(last);
    }
  }

  std::map<std::uint32_t, Entry> entries;
  std::vector<Entry> challengers;  ///< in the order in which they are tried again

 private:
  static void add(Entry& entry, const Result& result) {
    const double n = ++entry.evaluations;
    entry.objective += (result.objective - entry.objective) / n;
    double squares = 0.0;
    for (std::size_t i = 0; i < entry.descriptor.size(); ++i) {
      const double difference = double{result.descriptor[i]} - double{entry.descriptor[i]};
      squares += difference * difference;
      entry.descriptor[i] = static_cast<float>(double{entry.descriptor[i]} + difference / n);
    }
    entry.spread += squares * (n - 1.0) / n / dimensions;
  }

  const Entry* rival(const Entry& entry) const {
    const auto there = entries.find(cell_of(entry.descriptor));
    return there == entries.end() ? nullptr : &there->second;
  }
  bool would_enter(const Entry& entry) const {
    return !rival(entry) || entry.objective > rival(entry)->objective;
  }
  double stays(const Entry& entry) const {
    const Elite elite{.evaluations = entry.evaluations, .spread = entry.spread, .genome = {}};
    return staying_probability(*cells_, elite, entry.descriptor);
  }
  bool prevails(const Entry& entry) const {
    if (settings_.trials == 1 || !rival(entry)) return would_enter(entry);
    return entry.objective * stays(entry) > rival(entry)->objective * stays(*rival(entry));
  }
  double gain(const Entry& entry) const {
    return (entry.objective - (rival(entry) ? rival(entry)->objective : 0.0)) * stays(entry);
  }

  void decide(Entry entry) {
    if (!would_enter(entry)) return;
    const int evaluations = static_cast<int>(entry.evaluations);
    const int most =
        rival(entry) ? std::max(settings_.trials,
                                std::min(static_cast<int>(rival(entry)->evaluations), 4 * settings_.trials))
                     : settings_.trials;
    if (evaluations >= settings_.trials && prevails(entry))
      put(std::move(entry));
    else if (evaluations < most)
      challengers.push_back(std::move(entry));
  }

  void put(Entry entry) {
    entry.last = ++clock_;
    const std::uint32_t cell = cell_of(entry.descriptor);
    entries[cell] = std::move(entry);
  }

  MapElitesSettings settings_;
  std::unique_ptr<const Cells> cells_;
  int clock_ = 0;
};

}  // namespace amble::search::map_test
