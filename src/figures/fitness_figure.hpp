#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/record/objective.hpp"

namespace amble::figures {

/// Best, mean and median objective over the generations (of a map: over its evaluations), what the champion
/// so far typically does with the band between its quartiles, if the table has it, and below all this the
/// number of species and the size of the genomes, or coverage, QD score and best of a map: what the search
/// has columns of. An <svg> element. `generations` must not be empty.
std::string fitness_figure(const record::Generations& generations, FigureSize layout,
                           const record::Objective& objective = {});

}  // namespace amble::figures
