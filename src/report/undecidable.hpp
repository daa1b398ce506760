#pragma once

#include <string>
#include <vector>

#include "amble/ledger/study_spec.hpp"

namespace amble::report {

/// The claims that no outcome of a study's planned runs can decide or confirm, a line each with how many are
/// needed; judge() would find them not testable. And a line for claims of differences that none can be
/// confirmed, being too many.
std::vector<std::string> undecidable_claims(const ledger::StudySpec& study);

}  // namespace amble::report
