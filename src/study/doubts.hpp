#pragma once

#include <string>
#include <vector>

#include "amble/study/plan.hpp"

namespace amble::study {

/// What of a plan is hardly meant, a line each: two conditions that are the same, and claims that compare
/// what conditions with different scores got in evolution.
std::vector<std::string> doubts_of(const Plan& plan);

}  // namespace amble::study
