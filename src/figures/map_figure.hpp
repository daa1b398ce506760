#pragma once

#include <limits>
#include <string>
#include <vector>

namespace amble::figures {

/// A map of elites: a grid, and the objective in each of its cells.
struct GridMap {
  struct Dimension {
    std::string name;
    double least = 0.0, most = 1.0;
    int bins = 1;
  };
  std::vector<Dimension> dimensions;  ///< at least one
  /// Cell by cell, the last dimension's bin running fastest; NaN: empty.
  std::vector<double> objective;
  std::string unit;  ///< of the objective, e.g. " m"

  /// What the elite of a cell does in new trials.
  struct Typical {
    double objective = 0.0;
    bool stays = false;  ///< in its cell, by the mean of its descriptor
  };
  int trials = 0;                     ///< of each elite; 0: not tried again
  std::vector<Typical> typical = {};  ///< by cell, of those that are filled; empty without trials
};

/// The place of a cell in the picture, in cells from its left and its bottom. Dimensions nest (Cully et al.
/// 2015): the first, third … go to the right, the second, fourth … up, each within a bin of the one before.
struct MapPlace {
  int column = 0, row = 0;
  friend bool operator==(const MapPlace&, const MapPlace&) = default;
};
MapPlace place_of(const GridMap& map, std::size_t cell);

/// Cells as squares, darker where the objective is larger; a tooltip has the cell's number, bins and
/// objective, and the group of cell 12's square has the class "cell12". With new trials the tooltip has their
/// result too, and elites that leave their cell have small squares. An <svg> element. Throws UserError
/// for maps of more than 200,000 cells.
std::string map_figure(const GridMap& map);

/// The same as a whole SVG file.
std::string map_svg(const GridMap& map);

}  // namespace amble::figures
