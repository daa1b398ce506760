#include "amble/search/dominated_pool.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "amble/core/circle.hpp"

namespace amble::search {
std::vector<double> dominated_novelty(std::span<const PoolMember> members, std::size_t neighbours,
                                      std::span<const double> turns) {
  std::vector<double> novelties;
  std::vector<double> nearest;  // squared distances, rising
  for (std::size_t i = 0; i < members.size(); ++i) {
    nearest.clear();
    for (std::size_t j = 0; j < members.size(); ++j) {
      // Of equally good ones the first counts as better, or twins would drop out together.
      const bool dominates = members[j].objective > members[i].objective ||
                             (members[j].objective == members[i].objective && j < i);
      if (!dominates) continue;
      const double squares = squared_distance(members[i].descriptor, members[j].descriptor, turns);
      if (nearest.size() == neighbours && !(squares < nearest.back())) continue;
      nearest.insert(std::ranges::upper_bound(nearest, squares), squares);
      if (nearest.size() > neighbours) nearest.pop_back();
    }
    double sum = 0.0;
    for (const double squares : nearest) sum += std::sqrt(squares);
    novelties.push_back(nearest.empty() ? std::numeric_limits<double>::infinity()
                                        : sum / static_cast<double>(nearest.size()));
  }
  return novelties;
}

void DominatedPool::add(std::vector<PoolMember> members) {
  std::ranges::move(members, std::back_inserter(members_));
  const std::vector<double> novelties = dominated_novelty(members_, neighbours_, turns_);
  std::vector<std::size_t> order(members_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return novelties[a] > novelties[b]; });
  order.resize(std::min(size_, order.size()));
  std::vector<PoolMember> kept;
  kept.reserve(order.size());
  for (const std::size_t i : order) kept.push_back(std::move(members_[i]));
  members_ = std::move(kept);
}

void DominatedPool::save(io::BinaryWriter& writer) const {
  writer.put(static_cast<std::uint64_t>(members_.size()));
  for (const PoolMember& member : members_) {
    writer.put_span(std::span<const char>(member.genome));
    writer.put(member.objective);
    writer.put_span(std::span<const double>(member.descriptor));
  }
}

void DominatedPool::load(io::BinaryReader& reader, std::size_t dimensions) {
  const auto count = reader.get<std::uint64_t>();
  if (count > size_) reader.bad("more genomes than the pool holds");
  members_.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    PoolMember member;
    const auto genome = reader.get_vector<char>();
    member.genome.assign(genome.begin(), genome.end());
    member.objective = reader.get<double>();
    member.descriptor = reader.get_vector<double>();
    const bool finite =
        std::isfinite(member.objective) &&
        std::ranges::all_of(member.descriptor, [](double value) { return std::isfinite(value); });
    if (member.descriptor.size() != dimensions || !finite) reader.bad("a genome of another pool");
    members_.push_back(std::move(member));
  }
}

}  // namespace amble::search
