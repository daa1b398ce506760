#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace amble::search {

/// The best known solution of a cell.
struct Elite {
  std::uint32_t cell = 0;
  std::uint32_t round = 0;        ///< in which it was first evaluated
  std::uint32_t candidate = 0;    ///< its index in that round; both together name it
  std::uint32_t evaluations = 1;  ///< of which `objective` and its descriptor are the means
  double objective = 0.0;
  /// Sum over its evaluations of the squared differences of their descriptors from that mean, the mean over
  /// the dimensions, in units of their ranges. Kept where the search needs it; else 0.
  double spread = 0.0;
  std::string genome;  ///< in whatever form the search keeps it
};

/// An elite, wherever it is by now.
struct EliteName {
  std::uint32_t cell = std::numeric_limits<std::uint32_t>::max();  ///< where it was; the largest: of no elite
  std::uint32_t round = 0, candidate = 0;
};

/// The elites of a map, at most one per cell; there is no admission rule. Elites are numbered from 0
/// without gaps, in an order that depends on the calls so far alone; remove() gives the last elite the number
/// of the removed one. Memory: 90 bytes, the descriptor and the genome per elite, and 4 per cell.
class Elites {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  Elites(std::uint32_t cells, std::size_t dimensions);

  std::uint32_t cells() const { return static_cast<std::uint32_t>(number_in_.size()); }
  std::size_t dimensions() const { return dimensions_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(elites_.size()); }
  const Elite& operator[](std::uint32_t number) const { return elites_[number]; }
  std::span<const float> descriptor(std::uint32_t number) const {
    return std::span(descriptors_).subspan(number * dimensions_, dimensions_);
  }
  /// The number of the elite in `cell`, or `none`.
  std::uint32_t in(std::uint32_t cell) const { return number_in_[cell]; }

  /// Puts an elite into its cell, in the place of the one that was there.
  void put(Elite elite, std::span<const float> descriptor);
  /// Replaces the means of the elite that is in the cell of `elite` by those of `elite`.
  void update(const Elite& elite, std::span<const float> descriptor);
  /// Empties a cell that has an elite.
  void remove(std::uint32_t cell);

  /// The cells of at most `count` elites, those with the fewest evaluations first; of equal ones those whose
  /// last evaluation is longest ago.
  std::vector<std::uint32_t> least_evaluated(std::size_t count) const;

  /// Sum of the objectives (QD score of Pugh et al. 2016), in the order of numbers, and the largest.
  double objective_sum() const;
  double best_objective() const;

 private:
  void note_evaluated(std::uint32_t number);
  void forget_evaluated(std::uint32_t number);

  std::size_t dimensions_;
  std::vector<std::uint32_t> number_in_;  ///< by cell
  std::vector<Elite> elites_;             ///< by number
  std::vector<float> descriptors_;
  /// Each elite's evaluations, when it was last evaluated, its cell.
  std::set<std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>> queue_;
  std::vector<std::uint64_t> evaluated_;  ///< when, by number
  std::uint64_t clock_ = 0;               ///< counts evaluations noted
};

}  // namespace amble::search
