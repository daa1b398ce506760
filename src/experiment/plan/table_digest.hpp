#pragma once

#include <cstdint>
#include <string_view>

namespace amble::experiment {

/// The digest of a run's table after one more line (the header is the first, after 0): of all columns but
/// times, so the same for any number of workers. Never 0.
std::uint64_t table_digest(std::uint64_t before, std::string_view header, std::string_view line);

}  // namespace amble::experiment
