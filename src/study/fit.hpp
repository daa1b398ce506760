#pragma once

#include <string>
#include <vector>

#include "amble/study/plan.hpp"

namespace amble::study {

enum class RunStatus {
  missing,   ///< neither record nor run folder
  begun,     ///< a run folder that can be resumed
  untested,  ///< a record that lacks a test of the study
  done       ///< a record with all tests
};

/// The state of each run, in the order of Plan::runs, from the folders alone.
///
/// Throws UserError, and changes nothing, if a record or a run folder does not fit the study any more (other
/// settings, robot, generations or tests): one line that names all of them and why. A file that cannot be
/// read is reported likewise.
std::vector<RunStatus> survey(const Plan& plan);

}  // namespace amble::study
