#pragma once

#include <string>

#include "amble/graphics/layout.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::figures {

/// What evolution maximised, as texts name it and its values.
struct Objective {
  std::string name = "Distance walked";
  std::string unit = " m";  ///< behind a number, with its space; may be empty
};

/// Best, mean and median objective over the generations (of a map: over its evaluations), what the champion
/// so far typically does with the band between its quartiles, if the table has it, and below all this the
/// number of species and the size of the genomes, or coverage, QD score and best of a map: what the search
/// has columns of. An <svg> element. `generations` must not be empty.
std::string fitness_figure(const record::Generations& generations, graphics::Layout layout,
                           const Objective& objective = {});

}  // namespace amble::figures
