#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "amble/search/settings.hpp"

namespace amble::search {

/// Novelty search as one would write it first: plain loops in double precision, everything measured.
class NaiveNovelty {
 public:
  explicit NaiveNovelty(const NoveltySettings& settings)
      : settings_(settings), threshold(settings.threshold) {}

  std::vector<double> fitness_of(const std::vector<std::vector<float>>& generation) {
    std::vector<double> novelties;
    std::vector<bool> joined(generation.size());
    int added = 0;
    for (std::size_t i = 0; i < generation.size(); ++i) {
      std::vector<double> distances;
      for (const auto& member : archive) distances.push_back(distance(generation[i], member));
      for (std::size_t other = 0; other < generation.size(); ++other)
        if (settings_.compare_with == Neighbours::archive_and_population && other != i && !joined[other])
          distances.push_back(distance(generation[i], generation[other]));
      std::ranges::sort(distances);
      double novelty = 0.0;
      for (std::size_t k = 0; k < distances.size() && k < static_cast<std::size_t>(settings_.neighbours); ++k)
        novelty += distances[k];
      novelties.push_back(novelty);
      const int members = static_cast<int>(archive.size());
      if (members < settings_.archive_limit && (members < settings_.first_members || novelty > threshold)) {
        archive.push_back(generation[i]);
        joined[i] = true;
        if (settings_.count_first_members || novelty > threshold) ++added;
      }
    }
    adapt(added);
    return novelties;
  }

 private:
  double distance(const std::vector<float>& a, const std::vector<float>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      sum += difference * difference;
    }
    return settings_.distance == Distance::root ? std::sqrt(sum) : sum;
  }

  void adapt(int added) {
    if (added > settings_.raise_above) threshold *= settings_.raise_factor;
    empty_ = added > 0 ? 0 : empty_ + 1;
    if (empty_ < settings_.lower_after) return;
    threshold = std::min(threshold, std::max(threshold * settings_.lower_factor, settings_.lowest_threshold));
    if (settings_.lowering == Lowering::count_anew) empty_ = 0;
  }

  NoveltySettings settings_;
  int empty_ = 0;

 public:
  std::vector<std::vector<float>> archive;
  double threshold;
};

}  // namespace amble::search
