#pragma once

#include <string>

#include "amble/analysis/generations_csv.hpp"
#include "amble/analysis/layout.hpp"

namespace amble::analysis {

/// Best, mean and median distance over the generations, and below it how many species there were and how
/// large the genomes became. An <svg> element. `generations` must not be empty.
std::string fitness_figure(const Generations& generations, Layout layout);

}  // namespace amble::analysis
