#include "amble/figures/map_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr int shades = 9;
constexpr std::size_t most_drawn = 200'000;
constexpr double picture_px = 720.0, border_px = 56.0, scale_px = 54.0, below_px = 84.0;

/// The bin of each dimension.
std::vector<int> cell_bins(const GridMap& map, std::size_t cell) {
  std::vector<int> bins(map.dimensions.size());
  for (std::size_t i = bins.size(); i-- > 0;) {
    const auto count = to_index(map.dimensions[i].bins);
    bins[i] = static_cast<int>(cell % count);
    cell /= count;
  }
  return bins;
}

/// Cells in the direction of dimensions first, first + 2, …
int extent(const GridMap& map, std::size_t first) {
  int cells = 1;
  for (std::size_t i = first; i < map.dimensions.size(); i += 2) cells *= map.dimensions[i].bins;
  return cells;
}

/// Where cells are, in px: with gaps between the bins of all but the innermost dimensions.
class CellGrid {
 public:
  explicit CellGrid(const GridMap& map) : map_(map), columns_(extent(map, 0)), rows_(extent(map, 1)) {
    cell_px_ = std::clamp(picture_px / std::max(columns_, rows_), 2.0, 48.0);
    gap_px_ = std::min(6.0, cell_px_);
    width_px_ = left_px(columns_ - 1, 0) + cell_px_;
    height_px_ = left_px(rows_ - 1, 1) + cell_px_;
  }

  Box box(const MapPlace& place) const {
    const double inset = cell_px_ > 6.0 ? 0.5 : 0.0;
    return {border_px + left_px(place.column, 0) + inset,
            scale_px + height_px_ - left_px(place.row, 1) - cell_px_ + inset, cell_px_ - 2.0 * inset,
            cell_px_ - 2.0 * inset};
  }
  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }

 private:
  double left_px(int index, std::size_t first) const {
    double px = index * cell_px_;
    // A gap wherever a bin of an outer dimension ends.
    int inner = 1;
    for (std::size_t i = map_.dimensions.size(); i-- > first + 1;) {
      if (i % 2 != first) continue;
      inner *= map_.dimensions[i].bins;
      const int gaps = index / inner;
      px += gaps * gap_px_;
    }
    return px;
  }

  const GridMap& map_;
  int columns_, rows_;
  double cell_px_ = 0.0, gap_px_ = 0.0, width_px_ = 0.0, height_px_ = 0.0;
};

std::string cell_tooltip(const GridMap& map, std::size_t cell) {
  const auto bins = cell_bins(map, cell);
  std::string text = fmt::format("cell {}: {:.3f}{}", cell, map.objective[cell], map.unit);
  if (map.trials > 0)
    text += fmt::format("\nin {} new trials {:.3f}{}, {}", map.trials, map.typical[cell].objective, map.unit,
                        map.typical[cell].stays ? "stays in this cell" : "leaves this cell");
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const GridMap::Dimension& dimension = map.dimensions[i];
    const double width = (dimension.most - dimension.least) / dimension.bins;
    text += fmt::format("\n{} {:g} … {:g}", dimension.name, dimension.least + bins[i] * width,
                        dimension.least + (bins[i] + 1) * width);
  }
  return text;
}

/// "→ duty factor FL; within each block duty factor BL".
std::string axis_text(const GridMap& map, std::size_t first, std::string_view arrow) {
  std::string text;
  for (std::size_t i = first; i < map.dimensions.size(); i += 2)
    text += (text.empty() ? std::string(arrow) + " " : "; within each block ") + map.dimensions[i].name;
  std::ranges::replace(text, '_', ' ');
  return text;
}

/// The numbers between the bins of the outermost dimension in this direction, where there is room for them.
void draw_edges(Svg& svg, const GridMap& map, const CellGrid& grid, std::size_t first) {
  constexpr double least_px = 34.0;
  if (first >= map.dimensions.size()) return;
  const GridMap::Dimension& dimension = map.dimensions[first];
  const double length_px = first == 0 ? grid.width_px() : grid.height_px();
  const int every = std::max(1, static_cast<int>(std::ceil(least_px * dimension.bins / length_px)));
  for (int bin = 0; bin <= dimension.bins; bin += every) {
    const double value = dimension.least + bin * (dimension.most - dimension.least) / dimension.bins;
    const double px = length_px * bin / dimension.bins;
    const std::string text = fmt::format("{:.3g}", value);
    if (first == 0)
      svg.text({border_px + px, scale_px + grid.height_px() + 20.0}, Anchor::middle, "map-axis", text);
    else
      svg.text({border_px - 8.0, scale_px + grid.height_px() - px + 6.0}, Anchor::end, "map-axis", text);
  }
}

void draw_scale(Svg& svg, const GridMap& map, double best) {
  for (int shade = 0; shade < shades; ++shade) {
    svg.begin_group(fmt::format("shade{}", shade));
    svg.rect({border_px + 18.0 * shade, 14.0, 18.0, 12.0});
    svg.end_group();
  }
  svg.text({border_px, 44.0}, Anchor::start, "map-axis", "0");
  svg.text({border_px + 18.0 * shades, 44.0}, Anchor::end, "map-axis",
           fmt::format("{:.3g}{}", best, map.unit));
}

/// A cell's square; of an elite that leaves its cell a small one in an empty square, which takes the pointer
/// as well.
void draw_square(Svg& svg, const Box& box, bool is_whole) {
  if (is_whole) return svg.rect(box);
  constexpr double share = 0.4;
  svg.rect(box, "empty-cell");
  svg.rect({box.x + 0.5 * (1.0 - share) * box.width, box.y + 0.5 * (1.0 - share) * box.height,
            share * box.width, share * box.height});
}

}  // namespace

MapPlace place_of(const GridMap& map, std::size_t cell) {
  const auto bins = cell_bins(map, cell);
  MapPlace place;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    int& index = i % 2 == 0 ? place.column : place.row;
    index = index * map.dimensions[i].bins + bins[i];
  }
  return place;
}

std::string map_figure(const GridMap& map) {
  AMBLE_CHECK(
      !map.dimensions.empty() && map.objective.size() == to_index(extent(map, 0)) * to_index(extent(map, 1)),
      "a number per cell");
  AMBLE_CHECK(map.typical.size() == (map.trials > 0 ? map.objective.size() : 0), "new trials of each cell");
  if (map.objective.size() > most_drawn)
    fail(ExitCode::bad_input, "a map of {} cells: a picture has at most {}", map.objective.size(),
         most_drawn);
  double best = 0.0;
  std::size_t filled = 0;
  for (const double objective : map.objective)
    if (!std::isnan(objective)) best = std::max(best, objective), ++filled;

  const CellGrid grid(map);
  Svg svg(std::max(grid.width_px() + 2.0 * border_px, 420.0), grid.height_px() + scale_px + below_px,
          fmt::format("Map of {} elites in {} cells", filled, map.objective.size()));
  draw_scale(svg, map, best);
  for (std::size_t cell = 0; cell < map.objective.size(); ++cell) {
    const double objective = map.objective[cell];
    if (std::isnan(objective)) {
      svg.rect(grid.box(place_of(map, cell)), "empty-cell");
      continue;
    }
    const int shade = best > 0.0 ? std::min(shades - 1, static_cast<int>(shades * objective / best)) : 0;
    svg.begin_group(fmt::format("shade{} cell{}", shade, cell), cell_tooltip(map, cell));
    draw_square(svg, grid.box(place_of(map, cell)), map.trials == 0 || map.typical[cell].stays);
    svg.end_group();
  }
  const double below = scale_px + grid.height_px();
  for (const std::size_t direction : {0u, 1u}) draw_edges(svg, map, grid, direction);
  svg.text({border_px, below + 48.0}, Anchor::start, "map-axis", axis_text(map, 0, "→"));
  svg.text({border_px, below + 72.0}, Anchor::start, "map-axis", axis_text(map, 1, "↑"));
  if (map.trials > 0)
    svg.text({border_px + 18.0 * shades + 24.0, 25.0}, Anchor::start, "map-axis",
             fmt::format("small: leaves its cell in {} new trials", map.trials));
  return svg.finish();
}

std::string map_svg(const GridMap& map) {
  return figures::standalone_svg(map_figure(map));
}

}  // namespace amble::figures
