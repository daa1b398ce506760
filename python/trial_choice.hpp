#pragma once

#include <string>
#include <utility>

#include "amble/presentation/shown_trial.hpp"
#include "python/bind.hpp"

namespace amble::python {

/// The arguments level, noise, trials and undisturbed, which mean the same wherever there are champions.
/// ValueError for what contradicts itself.
inline presentation::TrialChoice trial_choice(std::string level, const py::object& noise, int trials,
                                              bool undisturbed = false) {
  if (trials != 0) check_whole("trials", trials, 1, presentation::most_typical_trials);
  presentation::TrialChoice choice{.level = std::move(level), .trials = trials};
  if (!noise.is_none()) choice.noise = path_of(noise);
  if (choice.noise && !choice.level.empty())
    throw py::value_error("level, noise: expected one of them, as either says what disturbs");
  if (undisturbed && choice.asked())
    throw py::value_error("undisturbed: expected no level, noise or trials beside it");
  choice.undisturbed = undisturbed;
  return choice;
}

}  // namespace amble::python
