#pragma once

#include <string>
#include <vector>

#include "amble/analysis/page.hpp"
#include "amble/analysis/recorded.hpp"

namespace amble::analysis {

/// A figure of a page as an SVG file of its own, for papers and slides.
struct FigureFile {
  std::string name;  ///< "filmstrip.svg", …
  std::string svg;
};

/// The figures that a page of `input` shows, in its order: filmstrip, fitness (with input.generations),
/// footfalls, patterns (SUPGs only) and path. Empty but for fitness if no step was recorded.
std::vector<FigureFile> figure_files(const PageInput& input, const Recorded& recorded);

}  // namespace amble::analysis
