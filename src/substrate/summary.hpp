#pragma once

#include <string>

#include "amble/substrate/layout.hpp"

namespace amble::substrate {

/// Text for people: the CPPN's inputs and outputs, every node, how many links there are between groups and by
/// which output, properties, and every link. `layout` was made from `settings`.
std::string summary(const Settings& settings, const Layout& layout);

}  // namespace amble::substrate
