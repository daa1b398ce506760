#pragma once

#include <cstddef>
#include <vector>

#include "amble/adaptation/gaussian_process.hpp"

namespace amble::adaptation {

/// A behaviour that a robot may try: its place in the map and what the map expects of it.
struct Candidate {
  std::vector<double> descriptor;  ///< each number in 0 … 1; the same count for all
  double expected = 0.0;           ///< ≥ 0
};

/// Parameters of the search; the defaults are those of Cully et al. 2015 (supplementary methods), for
/// performances that are shares of the best expected one.
struct TrialAndErrorSettings {
  double length_scale = 0.4;  ///< ρ of the kernel
  /// The noise of a trial. The published value is for trials that nearly repeat; noise that moves a trial by
  /// a tenth of the best expected performance has 0.01.
  double noise_variance = 0.001;
  double exploration = 0.05;  ///< κ of the upper confidence bound
  double stop_share = 0.9;    ///< α: stop when what was tried is predicted to reach this share of the best
  /// Of each number of a descriptor what a full turn is, the same again; 0: none. Empty: of none.
  std::vector<double> turns = {};
};

/// Intelligent trial and error (Cully, Clune, Tarapore & Mouret 2015): a Gaussian process learns how the
/// robot differs from the map. Its prior mean is the map, so that behaviours nobody tried are still expected
/// to do what the map says, less what similar ones lacked. Next comes the candidate with the largest upper
/// confidence bound μ + κ σ; of equal ones the first.
class TrialAndError {
 public:
  /// At least one candidate, one of them with `expected` > 0.
  explicit TrialAndError(std::vector<Candidate> candidates, const TrialAndErrorSettings& settings = {});

  std::size_t next() const;
  /// What a trial of a candidate gave, in the unit of `expected`.
  void tell(std::size_t candidate, double measured);
  /// Whether no candidate is predicted to be much better than the best of those tried.
  bool done() const;

  /// Expectation and standard deviation of a candidate by now, in the unit of `expected`.
  double mean(std::size_t candidate) const;
  double deviation(std::size_t candidate) const;
  /// The candidate with the largest expectation among those tried, which weighs what its trials gave by the
  /// noise of a trial; of equal ones the first. There must have been a trial.
  std::size_t best() const;

 private:
  std::vector<Candidate> candidates_;
  TrialAndErrorSettings settings_;
  double unit_;  ///< the best expected performance; all else is a share of it
  GaussianProcess process_;
  std::vector<double> mean_, deviation_;  ///< of each candidate
  std::vector<std::size_t> tried_;
};

}  // namespace amble::adaptation
