#pragma once

#include "amble/experiment/problem/problem.hpp"
#include "amble/io/json_file.hpp"

namespace amble::experiment {

/// The settings under which a champion is run again, as in its file, without the noise.
io::Json problem_json(const Problem& problem);

/// The problem of a champion file, its noise included, complete. Throws UserError for a missing or wrong key
/// and for parts that do not fit.
Problem problem_from_json(const io::JsonView& root);

}  // namespace amble::experiment
