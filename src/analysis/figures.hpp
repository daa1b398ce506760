#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/analysis/page.hpp"
#include "amble/analysis/recorded.hpp"

namespace amble::analysis {

/// A figure of a page as an SVG file of its own, for papers and slides.
struct FigureFile {
  std::string name;  ///< "filmstrip.svg", …
  std::string svg;
};

/// Every name that a figure may have.
inline constexpr std::array<std::string_view, 6> figure_names{"filmstrip.svg", "fitness.svg", "footfalls.svg",
                                                              "patterns.svg",  "network.svg", "path.svg"};

/// The figures that a page of `input` shows, in its order: filmstrip, fitness (with input.generations),
/// footfalls, patterns (SUPGs only), network (other controllers) and path. Empty but for fitness if no step
/// was recorded.
std::vector<FigureFile> figure_files(const PageInput& input, const Recorded& recorded);

}  // namespace amble::analysis
