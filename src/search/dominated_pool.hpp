#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "amble/io/binary.hpp"

namespace amble::search {

/// A genome that is bred from while it is unlike those that are better.
struct PoolMember {
  std::string genome;  ///< in whatever form the search keeps it
  double objective = 0.0;
  std::vector<double> descriptor;  ///< each number over its range: 0 … 1 where it is inside
};

/// Dominated novelty of each (Bahlous-Boldi et al., "Dominated Novelty Search", arXiv 2502.00593): the mean
/// distance of its descriptor to the `neighbours` nearest that are better, or as good and before it; of
/// fewer, if there are no more. Infinite for the first of the best. `turns`: of each number of the descriptor
/// what a full turn is, the same again; 0 where there is none; empty: of none.
std::vector<double> dominated_novelty(std::span<const PoolMember> members, std::size_t neighbours,
                                      std::span<const double> turns = {});

/// The genomes with the largest dominated novelty of all that were added: the population of that search,
/// without cells or bounds.
class DominatedPool {
 public:
  /// `turns` as in dominated_novelty().
  DominatedPool(std::size_t size, std::size_t neighbours, std::vector<double> turns = {})
      : size_(size), neighbours_(neighbours), turns_(std::move(turns)) {}

  std::span<const PoolMember> members() const { return members_; }
  /// Keeps the best of those in the pool and these; of equal ones those that came first.
  void add(std::vector<PoolMember> members);

  void save(io::BinaryWriter& writer) const;
  /// Throws UserError(bad_file) for more members than the pool holds, or other descriptors.
  void load(io::BinaryReader& reader, std::size_t dimensions);

 private:
  std::size_t size_, neighbours_;
  std::vector<double> turns_;
  std::vector<PoolMember> members_;
};

}  // namespace amble::search
