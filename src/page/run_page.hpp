#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/figures/fitness_figure.hpp"
#include "amble/motion/recorded_trial.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/record/objective.hpp"

/// The page of a run and its champion as HTML, and its figures as files.
namespace amble::page {

/// A row of the table at the end of a page.
struct Fact {
  std::string label, value;
};

struct CppnSize {
  int hidden = 0, links = 0;
};

/// The contents of a page, besides the recording of the champion. All texts are plain; the page escapes them.
struct RunPage {
  std::string title;
  std::string subtitle;
  std::optional<record::Generations> generations;  ///< none: the page does not mention the evolution
  record::Objective objective;                     ///< of the evolution
  std::optional<CppnSize> cppn;                    ///< of the champion
  std::vector<Fact> facts;                         ///< settings and provenance
  std::vector<std::string> commands;               ///< shell commands that make the page again
};

/// One self-contained HTML page, which is well-formed XML too: no network, no scripts.
std::string make_page(const RunPage& page, const motion::RecordedTrial& recorded);

}  // namespace amble::page

namespace amble::page {

/// A figure of a page as an SVG file of its own, for papers and slides.
struct FigureFile {
  std::string name;  ///< "filmstrip.svg", …
  std::string svg;
};

/// All names of figure files.
inline constexpr std::array<std::string_view, 8> figure_names{"filmstrip.svg", "walk.svg",     "fitness.svg",
                                                              "footfalls.svg", "patterns.svg", "network.svg",
                                                              "path.svg",      "steering.svg"};

/// The figures of the page, in its order: filmstrip and the same as an animation, fitness (if
/// page.generations has any), footfalls, patterns (SUPGs only), network (network controllers only) and path.
/// Without a recorded step there is fitness only.
std::vector<FigureFile> figure_files(const RunPage& page, const motion::RecordedTrial& recorded);

}  // namespace amble::page
