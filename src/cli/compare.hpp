#pragma once

#include <string>

namespace amble::cli {

/// How much of a distance is kept, "87 %"; "–" where there was none to keep.
std::string share_text(double distance_m, double of_m);

}  // namespace amble::cli
