#pragma once

#include <string>

#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// Bodies without mass (0) and without shapes, as files have them where two joints meet in a point: their
/// joints become the first ones of the body behind them, which moves as before; one with nothing behind it is
/// left out, with its joints. Returns the others that have no mass, named in one list; empty: none has.
std::string merge_massless_links(ModelParts& parts);

}  // namespace amble::morphology
