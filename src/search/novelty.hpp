#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "amble/search/archive_log.hpp"
#include "amble/search/behaviours.hpp"
#include "amble/search/criterion.hpp"
#include "amble/search/distance_estimates.hpp"
#include "amble/search/settings.hpp"

namespace amble::search {

/// Novelty search (Lehman & Stanley 2011; Morse et al. 2013, sec. 4): selects by how far a behaviour is from
/// its nearest neighbours among earlier ones. Elitism goes by the objective (neat::Fitness).
///
/// A generation is judged in index order, after all its trials. The novelty of a candidate is the sum of the
/// distances to its nearest neighbours in the current archive, which includes the candidates of its own
/// generation added before it; or in the archive and the rest of its generation, without duplicates. A
/// candidate is added to the archive if its novelty exceeds the threshold or the archive is still small. At
/// the end of the generation the threshold adapts to the number of candidates added; those added only because
/// the archive was small count if NoveltySettings::count_first_members is set.
class NoveltySearch : public Criterion {
 public:
  NoveltySearch(const NoveltySettings& settings, std::size_t behaviour_length);

  std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) override;
  void save(io::BinaryWriter& writer) const override;
  void load(io::BinaryReader& reader) override;
  bool has_archive() const override { return true; }
  std::string take_archive_growth() override { return log_.take_growth(archive_); }
  std::uint64_t restore_archive(io::InputFile& file, const std::string& what) override;
  /// archive: members after the generation; novelty_threshold: which they had to exceed; best_novelty.
  std::vector<Metric> metrics() const override;

  const Behaviours& archive() const { return archive_; }
  /// The threshold for the next generation.
  double threshold() const { return threshold_; }

 private:
  double novelty(std::span<const double> squared_distances) const;
  bool joins(double novelty) const;
  void adapt_threshold(int added);

  NoveltySettings settings_;
  Behaviours archive_;
  ArchiveLog log_;
  double threshold_;
  int empty_generations_ = 0;
  double last_threshold_ = 0.0, best_novelty_ = 0.0;  ///< of the generation judged last
};

/// A behaviour that may be among the nearest, with bounds on its distance.
struct Reference {
  Bounds squared_distance;
  std::span<const float> behaviour;
};

/// Exact squared distances from `from` to the `count` nearest references, ascending; fewer if there are
/// fewer. The bounds only save work: any valid bounds give the same result to the bit.
std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Reference> references, std::size_t count);

}  // namespace amble::search
