#include "amble/search/novelty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"
#include "amble/search/distance_estimates.hpp"
#include "amble/search/nearest.hpp"

namespace amble::search {
namespace {

/// Everyone that newcomers are compared with while their generation is judged.
class Crowd {
 public:
  Crowd(const Behaviours& archive, const Behaviours& newcomers, bool with_population)
      : archive_(archive),
        members_before_(archive.rows()),
        newcomers_(newcomers),
        counts_(newcomers.rows(), with_population),
        to_archive_(newcomers, archive),
        to_newcomers_(newcomers, newcomers) {}

  /// From now on the others are compared with this newcomer.
  void admit(std::size_t newcomer) { counts_[newcomer] = true; }

  const std::vector<Candidate>& around(std::size_t newcomer) {
    candidates_.clear();
    for (std::size_t member = 0; member < members_before_; ++member)
      candidates_.push_back({to_archive_.between(newcomer, member), archive_.row(member)});
    for (std::size_t other = 0; other < newcomers_.rows(); ++other)
      if (counts_[other] && other != newcomer)
        candidates_.push_back({to_newcomers_.between(newcomer, other), newcomers_.row(other)});
    return candidates_;
  }

 private:
  const Behaviours& archive_;
  std::size_t members_before_;  ///< those who join now are seen as newcomers
  const Behaviours& newcomers_;
  std::vector<bool> counts_;
  DistanceEstimates to_archive_, to_newcomers_;
  std::vector<Candidate> candidates_;
};

}  // namespace

NoveltySearch::NoveltySearch(const NoveltySettings& settings, std::size_t behaviour_length)
    : settings_(settings),
      archive_(behaviour_length, static_cast<std::size_t>(settings.archive_limit)),
      log_(behaviour_length),
      threshold_(settings.threshold) {}

std::vector<neat::Fitness> NoveltySearch::judge(std::span<const Evaluation> generation) {
  AMBLE_CHECK(!generation.empty(), "a generation has members");
  AMBLE_CHECK(archive_.rows() >= log_.members(), "load() is followed by restore_archive()");
  Behaviours newcomers(archive_.length(), generation.size());
  for (const auto& evaluation : generation) newcomers.append(evaluation.behaviour);

  Crowd crowd(archive_, newcomers, settings_.compare_with == Neighbours::archive_and_population);
  std::vector<neat::Fitness> fitness;
  last_threshold_ = threshold_;
  best_novelty_ = 0.0;
  int added = 0;
  for (std::size_t i = 0; i < generation.size(); ++i) {
    const double own = novelty(nearest_squared_distances(newcomers.row(i), crowd.around(i),
                                                         static_cast<std::size_t>(settings_.neighbours)));
    fitness.push_back({.selection = own, .objective = generation[i].objective});
    best_novelty_ = std::max(best_novelty_, own);
    if (!joins(own)) continue;
    archive_.append(newcomers.row(i));
    crowd.admit(i);
    if (own > threshold_ || settings_.count_first_members) ++added;
  }
  adapt_threshold(added);
  return fitness;
}

std::vector<Reading> NoveltySearch::readings() const {
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
  if (archive_.rows() >= static_cast<std::size_t>(settings_.archive_limit)) return false;
  return novelty > threshold_ || archive_.rows() < static_cast<std::size_t>(settings_.first_members);
}

void NoveltySearch::adapt_threshold(int added) {
  empty_generations_ = added == 0 ? empty_generations_ + 1 : 0;
  if (added > settings_.raise_above)
    threshold_ = std::min(std::numeric_limits<double>::max(), threshold_ * settings_.raise_factor);
  if (empty_generations_ < settings_.lower_after) return;
  threshold_ = std::max(settings_.lowest_threshold, threshold_ * settings_.lower_factor);
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
  log_.load(reader, static_cast<std::size_t>(settings_.archive_limit));
}

std::uint64_t NoveltySearch::restore_archive(io::InputFile& file, const std::string& what) {
  return log_.restore(file, what, archive_);
}

}  // namespace amble::search
