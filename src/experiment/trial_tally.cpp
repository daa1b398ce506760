#include "amble/experiment/trial_tally.hpp"

#include <fmt/format.h>

namespace amble::experiment {
namespace {

/// More than this share of trials must count.
constexpr double least_share = 0.1;
/// A trial that falls within this share of its length shows nothing of a controller.
constexpr double at_once_share = 0.01;

}  // namespace

void TrialTally::add(std::span<const record::Trajectory> trajectories, int full_steps) {
  trials_ += trajectories.size();
  for (const auto& trajectory : trajectories) {
    diverged_ += trajectory.outcome == record::Outcome::diverged;
    at_once_ +=
        trajectory.outcome == record::Outcome::fell && trajectory.steps <= 1 + at_once_share * full_steps;
  }
}

std::string TrialTally::verdict() const {
  if (trials_ == 0 ||
      static_cast<double>(trials_ - diverged_ - at_once_) > least_share * static_cast<double>(trials_))
    return {};
  std::string how;
  if (diverged_ > 0) how = fmt::format("{} of {} trials diverged", diverged_, trials_);
  if (at_once_ > 0)
    how += fmt::format("{}{} of {} fell at once", how.empty() ? "" : " and ", at_once_, trials_);
  return fmt::format(
      "{}, so the results mean nothing: see what is odd about the robot by `amble robot`, a smaller "
      "trial.timestep_s may help",
      how);
}

}  // namespace amble::experiment
