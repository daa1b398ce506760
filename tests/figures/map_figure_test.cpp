#include "amble/figures/map_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "tests/figures/xml.hpp"

namespace amble::figures {
namespace {

constexpr double empty = std::numeric_limits<double>::quiet_NaN();

GridMap map_of(const std::vector<int>& bins) {
  GridMap map;
  std::size_t cells = 1;
  for (const int count : bins) {
    map.dimensions.push_back({"d<" + std::to_string(count), 0.0, 1.0, count});
    cells *= static_cast<std::size_t>(count);
  }
  map.objective.assign(cells, empty);
  map.unit = " m";
  return map;
}

TEST(MapFigure, NestsTheThirdDimensionInTheFirstAndTheFourthInTheSecond) {
  const GridMap map = map_of({2, 3, 4, 5});
  EXPECT_EQ(place_of(map, 0), (MapPlace{0, 0}));
  EXPECT_EQ(place_of(map, 1), (MapPlace{0, 1})) << "the last bin runs fastest";
  EXPECT_EQ(place_of(map, 5), (MapPlace{1, 0}));
  EXPECT_EQ(place_of(map, 4 * 5), (MapPlace{0, 5}));
  EXPECT_EQ(place_of(map, 3 * 4 * 5), (MapPlace{4, 0}));
  EXPECT_EQ(place_of(map, 2 * 3 * 4 * 5 - 1), (MapPlace{7, 14}));
}

TEST(MapFigure, GivesEachCellAPlaceOfItsOwn) {
  for (const std::vector<int>& bins : {std::vector{7}, {3, 4}, {2, 3, 4}, {2, 2, 3, 2, 2}}) {
    const GridMap map = map_of(bins);
    std::set<std::pair<int, int>> places;
    for (std::size_t cell = 0; cell < map.objective.size(); ++cell)
      places.emplace(place_of(map, cell).column, place_of(map, cell).row);
    EXPECT_EQ(places.size(), map.objective.size());
  }
}

TEST(MapFigure, DrawsEachCellAndNamesThoseThatAreFilled) {
  GridMap map = map_of({4, 3, 2});
  map.objective[5] = 0.0;
  map.objective[23] = 2.5;
  const std::string svg = map_svg(map);
  EXPECT_FALSE(amble::tests::parse_xml(svg).empty()) << "well-formed";
  EXPECT_THAT(svg, testing::HasSubstr("Map of 2 elites in 24 cells"));
  EXPECT_THAT(svg, testing::HasSubstr("cell 23: 2.500 m\nd&lt;4 0.75 … 1\n"));
  EXPECT_THAT(svg, testing::HasSubstr("cell 5: 0.000 m"));
  std::size_t empty_cells = 0;
  for (std::size_t at = svg.find("\"empty-cell\""); at != std::string::npos;
       at = svg.find("\"empty-cell\"", at + 1))
    ++empty_cells;
  EXPECT_EQ(empty_cells, 22u);
}

TEST(MapFigure, SaysWhichElitesStayInTheirCellInNewTrials) {
  GridMap map = map_of({4, 3});
  map.objective[5] = 2.0;
  map.objective[7] = 3.0;
  const std::string before = map_svg(map);
  EXPECT_THAT(before, testing::Not(testing::HasSubstr("new trials")));
  map.trials = 20;
  map.typical.resize(12);
  map.typical[5] = {1.5, true};
  map.typical[7] = {0.25, false};
  const std::string svg = map_svg(map);
  EXPECT_FALSE(amble::tests::parse_xml(svg).empty()) << "well-formed";
  EXPECT_THAT(svg, testing::HasSubstr("cell 5: 2.000 m\nin 20 new trials 1.500 m, stays in this cell\n"));
  EXPECT_THAT(svg, testing::HasSubstr("cell 7: 3.000 m\nin 20 new trials 0.250 m, leaves this cell\n"));
  const auto rects = [](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find("<rect"); at != std::string::npos; at = text.find("<rect", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(rects(svg), rects(before) + 1) << "the small square of cell 7 in its empty one";
}

/// The numbers under the scale of colours.
std::pair<std::string, std::string> scale(const GridMap& map) {
  std::vector<std::string> ticks;
  const std::string svg = map_svg(map);
  const std::string tick = "class=\"map-axis\"";
  for (std::size_t at = svg.find(tick); at != std::string::npos; at = svg.find(tick, at + 1)) {
    const std::size_t begin = svg.find('>', at) + 1;
    ticks.push_back(svg.substr(begin, svg.find('<', begin) - begin));
  }
  EXPECT_GE(ticks.size(), 2u);
  ticks.resize(2);
  return {ticks[0], ticks[1]};
}

TEST(MapFigure, HasAScaleFromZeroToTheBestAndNeverBelowZero) {
  GridMap map = map_of({2, 2});
  EXPECT_EQ(scale(map), (std::pair<std::string, std::string>{"0", "0 m"})) << "empty-cell";
  map.objective[1] = -2.0;
  EXPECT_EQ(scale(map), (std::pair<std::string, std::string>{"0", "0 m"})) << "only one that went backwards";
  EXPECT_THAT(map_svg(map), testing::HasSubstr("shade0 cell1"));
  map.objective[2] = 1.25;
  EXPECT_EQ(scale(map), (std::pair<std::string, std::string>{"0", "1.25 m"}));
}

TEST(MapFigure, OfTooManyCellsIsRefused) {
  EXPECT_THROW(map_svg(map_of({1000, 1000})), UserError);
}

TEST(MapFigure, HasTwoHundredThousandCellsAndNoMore) {
  const auto refusal = [](int columns, int rows) -> std::string {
    GridMap map;
    map.dimensions = {{.name = "a", .least = 0.0, .most = 1.0, .bins = columns},
                      {.name = "b", .least = 0.0, .most = 1.0, .bins = rows}};
    map.objective.assign(static_cast<std::size_t>(columns * rows), std::nan(""));
    try {
      map_figure(map);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(400, 500), "");
  EXPECT_EQ(refusal(200'001, 1), "a map of 200001 cells: a picture has at most 200000");
}

}  // namespace
}  // namespace amble::figures
