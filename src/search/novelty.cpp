#include "amble/search/novelty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/search/distance_estimates.hpp"

namespace amble::search {
namespace {

/// The behaviours that candidates are compared with while their generation is judged.
class ComparisonSet {
 public:
  ComparisonSet(const Behaviours& archive, const Behaviours& candidates, bool with_population)
      : archive_(archive),
        members_before_(archive.rows()),
        candidates_(candidates),
        included_(candidates.rows(), with_population),
        to_archive_(candidates, archive),
        to_candidates_(candidates, candidates) {}

  /// From now on other candidates are compared with this one.
  void include(std::size_t candidate) { included_[candidate] = true; }

  const std::vector<Reference>& around(std::size_t candidate) {
    references_.clear();
    for (std::size_t member = 0; member < members_before_; ++member)
      references_.push_back({to_archive_.between(candidate, member), archive_.row(member)});
    for (std::size_t other = 0; other < candidates_.rows(); ++other)
      if (included_[other] && other != candidate)
        references_.push_back({to_candidates_.between(candidate, other), candidates_.row(other)});
    return references_;
  }

 private:
  const Behaviours& archive_;
  std::size_t members_before_;  ///< members added meanwhile are compared as candidates
  const Behaviours& candidates_;
  std::vector<bool> included_;
  DistanceEstimates to_archive_, to_candidates_;
  std::vector<Reference> references_;
};

/// An upper bound of the `count`-th smallest squared distance: the `count`-th smallest upper bound.
double reach_of(std::span<const Reference> references, std::size_t count) {
  if (references.size() <= count) return std::numeric_limits<double>::infinity();
  std::vector<double> upper;
  upper.reserve(references.size());
  for (const auto& reference : references) upper.push_back(reference.squared_distance.upper);
  const auto last = upper.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::ranges::nth_element(upper, last);
  return *last;
}

}  // namespace

NoveltySearch::NoveltySearch(const NoveltySettings& settings, std::size_t behaviour_length)
    : settings_(settings),
      archive_(behaviour_length, to_index(settings.archive_limit)),
      log_(behaviour_length),
      threshold_(settings.threshold) {}

std::vector<neat::Fitness> NoveltySearch::fitness_of(std::span<const Evaluation> generation) {
  AMBLE_CHECK(!generation.empty(), "a generation has members");
  AMBLE_CHECK(archive_.rows() >= log_.members(), "load() is followed by restore_archive()");
  Behaviours candidates(archive_.length(), generation.size());
  for (const auto& evaluation : generation) candidates.append(evaluation.behaviour);

  ComparisonSet comparison(archive_, candidates,
                           settings_.compare_with == Neighbours::archive_and_population);
  std::vector<neat::Fitness> fitness;
  last_threshold_ = threshold_;
  best_novelty_ = 0.0;
  int added = 0;
  for (std::size_t i = 0; i < generation.size(); ++i) {
    const double own = novelty(
        nearest_squared_distances(candidates.row(i), comparison.around(i), to_index(settings_.neighbours)));
    fitness.push_back({.selection = own, .objective = generation[i].objective});
    best_novelty_ = std::max(best_novelty_, own);
    if (!joins(own)) continue;
    archive_.append(candidates.row(i));
    comparison.include(i);
    if (own > threshold_ || settings_.count_first_members) ++added;
  }
  adapt_threshold(added);
  return fitness;
}

std::vector<Metric> NoveltySearch::metrics() const {
  return {{"archive", static_cast<double>(archive_.rows())},
          {"novelty_threshold", last_threshold_},
          {"best_novelty", best_novelty_}};
}

double NoveltySearch::novelty(std::span<const double> squared_distances) const {
  double sum = 0.0;
  for (const double squared : squared_distances)
    sum += settings_.distance == Distance::squared ? squared : std::sqrt(squared);
  return sum;
}

bool NoveltySearch::joins(double novelty) const {
  if (archive_.rows() >= to_index(settings_.archive_limit)) return false;
  return novelty > threshold_ || archive_.rows() < to_index(settings_.first_members);
}

void NoveltySearch::adapt_threshold(int added) {
  empty_generations_ = added == 0 ? empty_generations_ + 1 : 0;
  if (added > settings_.raise_above)
    threshold_ = std::min(std::numeric_limits<double>::max(), threshold_ * settings_.raise_factor);
  if (empty_generations_ < settings_.lower_after) return;
  // A threshold that began below the lowest stays: lowering never raises.
  threshold_ =
      std::min(threshold_, std::max(settings_.lowest_threshold, threshold_ * settings_.lower_factor));
  if (settings_.lowering == Lowering::count_anew) empty_generations_ = 0;
}

void NoveltySearch::save(io::BinaryWriter& writer) const {
  AMBLE_CHECK(log_.members() == archive_.rows(), "the archive is written down before save()");
  writer.put(threshold_);
  writer.put(static_cast<std::int32_t>(empty_generations_));
  log_.save(writer);
}

void NoveltySearch::load(io::BinaryReader& reader) {
  threshold_ = reader.get<double>();
  empty_generations_ = reader.get<std::int32_t>();
  if (!std::isfinite(threshold_) || threshold_ < 0.0 || empty_generations_ < 0)
    reader.bad("a novelty threshold that cannot be");
  log_.load(reader, to_index(settings_.archive_limit));
}

std::uint64_t NoveltySearch::restore_archive(io::InputFile& file, const std::string& what) {
  return log_.restore(file, what, archive_);
}

std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Reference> references, std::size_t count) {
  if (count == 0) return {};
  const double reach = reach_of(references, count);
  std::vector<double> distances;
  // A reference whose lower bound exceeds the reach cannot be among the nearest.
  for (const auto& reference : references)
    if (reference.squared_distance.lower <= reach)
      distances.push_back(exact_squared_distance(from, reference.behaviour));
  const std::size_t kept = std::min(count, distances.size());
  std::ranges::partial_sort(distances, distances.begin() + static_cast<std::ptrdiff_t>(kept));
  distances.resize(kept);
  return distances;
}

}  // namespace amble::search
