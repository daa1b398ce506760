#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"

namespace amble::experiment {

/// trial::TraceObserver's hashes in files: eight hexadecimal digits per step.
std::string trace_text(const std::vector<std::uint32_t>& trace);
/// Throws UserError(ExitCode::bad_file).
std::vector<std::uint32_t> parse_trace(const io::JsonView& view);

}  // namespace amble::experiment
