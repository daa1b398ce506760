#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "amble/neat/settings.hpp"
#include "amble/search/covariance_adaptation.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategies.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// CMA-ES (covariance_adaptation.hpp) on the weights of one CPPN that never grows: the initial genome, in
/// which bias and inputs are linked with all outputs. A round is population.size samples; the better half by
/// objective moves the distribution, and ties go to the candidate that comes first. One that is not viable
/// ranks last; where fewer than half are viable, some that are not are among the better half.
///
/// Begins around an initial genome, drawn as NEAT's are. Begins again around another when the distribution
/// has contracted to nothing (settings.least_step), has grown to `most_growth` times its first width, lost
/// its shape to rounding, or when all candidates of a round are alike: the tutorial's TolX, TolXUp
/// and ConditionCov (app. B.3); the last as emitters do (cma_emitters.hpp). Growth without end is what
/// outputs that saturate lead to: no weight is too large for them.
class CmaEs : public Strategy {
 public:
  /// Of the standard deviation of a weight, to that of the first round.
  static constexpr double most_growth = 1e4;

  /// The settings must be valid, and `space.neat` with at least 4 genomes.
  CmaEs(const CmaEsSettings& settings, const SearchSpace& space);

  int round() const override { return round_; }
  std::span<const neat::Genome> ask() const override { return candidates_; }
  void tell(std::span<const Evaluation> evaluations) override;
  /// Of the distribution of the next round: "cma_step", the step length; "cma_widest", the largest standard
  /// deviation of a weight; "cma_restarts", how often it began again.
  std::vector<Metric> metrics() const override;

  void save(io::BinaryWriter& writer) const override;
  void load(io::BinaryReader& reader) override;

  const CovarianceAdaptation& distribution() const { return distribution_; }

 private:
  neat::Genome initial_genome(int start) const;
  CovarianceAdaptation new_distribution(int start) const;
  void sample();
  /// Whether nothing more can be expected of the distribution after this round.
  bool is_over(std::span<const Evaluation> evaluations) const;

  CmaEsSettings settings_;
  neat::Settings neat_;
  int inputs_, outputs_;
  std::uint64_t seed_;
  int round_ = 0, restarts_ = 0;
  CovarianceAdaptation distribution_;
  std::vector<neat::Genome> candidates_;
};

}  // namespace amble::search
