#pragma once

#include <cstdint>

#include "amble/experiment/plan/checkpoint.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

/// Compares generations.csv with what the run wrote, before anything is cut off it: rows up to the
/// checkpoint's, to the bit if it has their digest; after them no more than a killed process may have left.
/// Returns the digest of the rows that stay. Throws UserError(ExitCode::bad_file) naming the line, what was
/// expected and how to go on: a spreadsheet or an editor may have saved it anew.
std::uint64_t check_table(const RunPaths& paths, const Progress& progress, const search::Strategy& strategy);

}  // namespace amble::experiment
