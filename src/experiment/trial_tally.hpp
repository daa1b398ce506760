#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "amble/record/trajectory.hpp"

namespace amble::experiment {

/// How the trials of a run ended, as far as this process made them.
class TrialTally {
 public:
  /// `full_steps`: length of a trial that nothing ends early.
  void add(std::span<const record::Trajectory> trajectories, int full_steps);

  std::uint64_t trials() const { return trials_; }
  std::uint64_t diverged() const { return diverged_; }
  /// Why the results mean nothing, as a sentence: hardly any trial was one. Empty otherwise, and without any
  /// trial.
  std::string verdict() const;

 private:
  std::uint64_t trials_ = 0, diverged_ = 0, at_once_ = 0;
};

}  // namespace amble::experiment
