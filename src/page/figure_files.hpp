#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/page/run_page.hpp"

namespace amble::page {

/// A figure of a page as an SVG file of its own, for papers and slides.
struct FigureFile {
  std::string name;  ///< "filmstrip.svg", …
  std::string svg;
};

/// All names of figure files.
inline constexpr std::array<std::string_view, 7> figure_names{
    "filmstrip.svg", "walk.svg", "fitness.svg", "footfalls.svg", "patterns.svg", "network.svg", "path.svg"};

/// The figures of the page, in its order: filmstrip and the same as an animation, fitness (if
/// page.generations has any), footfalls, patterns (SUPGs only), network (network controllers only) and path.
/// Without a recorded step there is fitness only.
std::vector<FigureFile> figure_files(const RunPage& page, const motion::RecordedTrial& recorded);

}  // namespace amble::page
