#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"

namespace amble::view {

/// One robot on the page.
struct Walker {
  std::string title;
  std::filesystem::path recording;
  std::string cppn_svg;  ///< figures::cppn_figure() of its controller; empty: unknown
  io::Json gait;         ///< "amble-gait" (docs/FORMATS.md); null: the page shows duty factors only
};

/// The contents of the replay page.
struct ReplayPage {
  std::string title;
  std::vector<Walker> walkers;  ///< at least one
  std::string made_by;          ///< program and version, for the foot of the page
};

/// A self-contained page that shows the walkers moving, in 3-D, with diagrams tied to the time: no network,
/// any browser of 2023 or later. Throws UserError as pack_recording() does.
std::string make_page(const ReplayPage& page);

}  // namespace amble::view
