#pragma once

#include "amble/figures/cppn_figure.hpp"
#include "amble/figures/cppn_graph.hpp"
#include "amble/figures/filmstrip_figure.hpp"
#include "amble/figures/fitness_figure.hpp"
#include "amble/figures/footfall_figure.hpp"
#include "amble/figures/path_figure.hpp"
#include "amble/figures/pattern_figure.hpp"
#include "amble/figures/steering_figure.hpp"
#include "amble/figures/substrate_figure.hpp"

/// One function per figure: data in, an <svg> element out.
///
///   of a run         fitness_figure.hpp      distance, species and genome sizes over the generations
///   of a recording   filmstrip_figure.hpp    poses seen from the side, still and moving
///                    footfall_figure.hpp     Hildebrand's footfall diagram
///                    path_figure.hpp         the path over the ground, from above
///                    steering_figure.hpp     what it was told beside what it did
///   of a controller  pattern_figure.hpp      temporal patterns of a SUPG
///                    substrate_figure.hpp    nodes and links of a substrate
///                    cppn_figure.hpp         the CPPN; cppn_graph.hpp: for Graphviz
///
/// Inside of them: side_view.hpp (projections of a robot), substrate_graph.hpp and cppn_graph.hpp (what is
/// drawn, and where), cppn_detours.hpp (routes of links).
namespace amble::figures {}
