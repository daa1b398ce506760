#pragma once

#include <string>

#include "amble/graphics/layout.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::figures {

/// Best, mean and median distance over the generations, and below it the number of species and the size of
/// the genomes, if the search has such columns. An <svg> element. `generations` must not be empty.
std::string fitness_figure(const record::Generations& generations, graphics::Layout layout);

}  // namespace amble::figures
