#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"

namespace amble::page {

/// One robot on the page.
struct Walker {
  std::string title;
  std::filesystem::path recording;
  std::string cppn_svg;  ///< figures::cppn_figure() of its controller; empty: unknown
  io::Json gait;         ///< "amble-gait" (docs/FORMATS.md); null: the page shows duty factors only
  std::optional<std::uint32_t> cell = {};  ///< of the map that the page shows; with a map all have one
  /// The text of its champion's file: then the page can also simulate it (docs/BROWSER.md). Empty: it cannot.
  std::string champion = {};
  /// What it typically does, in words, and which trial is shown, e.g. "its median trial"; empty: unknown.
  std::string typical = {}, shown = {};
  bool as_evolved = false;  ///< nothing else was asked of its walk: if it obeys commands, its page opens live
};

/// A map of elites from which the reader chooses the walkers that are shown.
struct MapPanel {
  std::string map_svg;     ///< figures::map_figure()
  std::string curves_svg;  ///< figures::fitness_figure(); empty: none
  std::string note;        ///< a sentence on which cells can be chosen
  /// Head and rows of a table below the map; empty: none. A row begins with the number of a cell that can be
  /// chosen.
  std::vector<std::vector<std::string>> table = {};
  std::string table_title = {}, table_note = {};
};

/// The contents of the replay page.
struct ReplayPage {
  std::string title;
  std::vector<Walker> walkers;  ///< at least one
  std::string made_by;          ///< program and version, for the foot of the page
  /// With a map the page begins with the first walker, and shows others when their cells are chosen; then
  /// poses are 0.04 s apart.
  std::optional<MapPanel> map = {};
};

/// A self-contained page that shows the walkers moving, in 3-D, with diagrams tied to the time: no network,
/// any browser of 2023 or later. Throws UserError as pack_recording() does.
std::string make_page(const ReplayPage& page);

}  // namespace amble::page
