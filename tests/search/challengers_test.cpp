#include "amble/search/challengers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"

namespace amble::search {
namespace {

std::vector<DescriptorSettings> two_dimensions(int bins) {
  std::vector<DescriptorSettings> two(2);
  two[0].bins = bins;
  two[1].bins = bins;
  two[1].least = -90.0;
  two[1].most = 90.0;
  return two;
}

/// The share of points around `descriptor` that are in its cell. `round`: the second dimension is a circle.
double counted_share(const Cells& cells, const std::vector<float>& descriptor, double deviation,
                     bool round = false) {
  Stream stream(1, Purpose::test, 2, 3);
  const std::uint32_t cell = cells.of(descriptor);
  constexpr int points = 40000;
  int inside = 0;
  for (int i = 0; i < points; ++i) {
    std::vector<float> point{descriptor[0] + static_cast<float>(deviation * stream.normal()),
                             descriptor[1] + static_cast<float>(180.0 * deviation * stream.normal())};
    if (round) point[1] -= 180.0f * std::floor((point[1] + 90.0f) / 180.0f);
    inside += cells.of(point) == cell;
  }
  return inside / static_cast<double>(points);
}

TEST(ShareInside, OfAGridIsThatOfPointsDrawn) {
  const auto settings = two_dimensions(5);
  const GridCells cells(settings);
  for (const float x : {0.0f, 0.11f, 0.2f, 0.5f, 0.95f, 1.3f})
    for (const float y : {-100.0f, -90.0f, -1.0f, 53.0f, 90.0f})
      for (const double deviation : {0.02, 0.1, 0.4}) {
        const std::vector<float> descriptor{x, y};
        // Standard error at most 0.0025.
        EXPECT_NEAR(cells.share_inside(descriptor, deviation), counted_share(cells, descriptor, deviation),
                    0.011)
            << x << " " << y << " " << deviation;
      }
}

/// Of squares, so that cells are the cubes which stand for them.
TEST(ShareInside, OfCentroidsIsThatOfPointsDrawnAtTheEndsOfRangesToo) {
  std::vector<float> centroids;
  for (const float x : {1.0f, 3.0f, 5.0f})
    for (const float y : {1.0f, 3.0f, 5.0f}) centroids.insert(centroids.end(), {x / 6.0f, y / 6.0f});
  const CentroidCells cells(two_dimensions(1), centroids);
  for (const float x : {-0.2f, 0.0f, 0.3f, 0.5f, 0.95f, 1.0f})
    for (const float y : {-100.0f, -90.0f, -1.0f, 53.0f, 90.0f})
      for (const double deviation : {0.02, 0.1, 0.4}) {
        const std::vector<float> descriptor{x, y};
        EXPECT_NEAR(cells.share_inside(descriptor, deviation), counted_share(cells, descriptor, deviation),
                    0.011)
            << x << " " << y << " " << deviation;
      }
  const std::vector<float> middle{0.5f, 0.0f}, border{1.0f / 3.0f, 0.0f};
  EXPECT_NEAR(cells.share_inside(middle, 1.0 / 6.0), 0.6827 * 0.6827, 1e-3) << "one deviation to each side";
  EXPECT_NEAR(cells.share_inside(border, 1e-3), 0.5, 1e-3);
}

TEST(ShareInside, OfACircleEndsAtItsSeam) {
  const std::vector<Circle> circles{{}, {.lowest = -90.0, .turn = 180.0}};
  std::vector<float> centroids;
  for (const float x : {1.0f, 3.0f, 5.0f})
    for (const float y : {1.0f, 3.0f, 5.0f}) centroids.insert(centroids.end(), {x / 6.0f, y / 6.0f});
  MapElitesSettings settings;
  settings.descriptors = two_dimensions(5);
  const auto grid = make_cells(settings, circles);
  const CentroidCells cvt(two_dimensions(1), centroids, circles);
  for (const Cells* const cells : {grid.get(), static_cast<const Cells*>(&cvt)})
    for (const float x : {0.0f, 0.5f})
      for (const float y : {-90.0f, -88.0f, -60.0f, 0.0f, 53.0f, 89.9f})
        for (const double deviation : {0.02, 0.1}) {
          const std::vector<float> descriptor{x, y};
          EXPECT_NEAR(cells->share_inside(descriptor, deviation),
                      counted_share(*cells, descriptor, deviation, true), 0.011)
              << x << " " << y << " " << deviation;
        }
}

/// Cells of many dimensions are no cubes; those at the ends of ranges still go on beyond.
TEST(ShareInside, OfSpreadCentroidsGrowsTowardsTheEndsOfRanges) {
  const std::vector<DescriptorSettings> unit(4);
  const CentroidCells cells(unit, spread_centroids(300, 4, 6000, 1));
  for (std::uint32_t cell = 0; cell < cells.count(); ++cell) {
    std::vector<float> at(cells.centroids().begin() + 4 * cell, cells.centroids().begin() + 4 * (cell + 1));
    at[2] = 1.0f;
    if (cells.of(at) != cell) continue;
    const double at_end = cells.share_inside(at, 0.1);
    at[2] = 1.2f;
    EXPECT_GT(cells.share_inside(at, 0.1), at_end) << cell;
  }
}

TEST(StayingProbability, RisesWithEvaluationsAndFallsWithTheirSpread) {
  const auto settings = two_dimensions(5);
  const GridCells cells(settings);
  const std::vector<float> middle{0.5f, 0.0f}, border{0.41f, 0.0f};
  const auto stays = [&](std::uint32_t evaluations, double deviation, const std::vector<float>& at) {
    const Elite elite{
        .evaluations = evaluations, .spread = deviation * deviation * (evaluations - 1.0), .genome = {}};
    return staying_probability(cells, elite, at);
  };
  EXPECT_LT(stays(1, 0.0, middle), stays(2, 0.16, middle));
  EXPECT_LT(stays(2, 0.16, middle), stays(20, 0.16, middle));
  EXPECT_LT(stays(20, 0.3, middle), stays(20, 0.16, middle));
  EXPECT_LT(stays(20, 0.16, middle), stays(20, 0.05, middle));
  EXPECT_LT(stays(20, 0.16, border), stays(20, 0.16, middle));
  EXPECT_GT(stays(1000, 0.01, middle), 0.999);
}

/// Challengers of objectives 0, 1, 2, … in the middle of the cells 0, 1, 2, ….
std::vector<Challenger> challengers_of(int count) {
  std::vector<Challenger> challengers(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Challenger& challenger = challengers[static_cast<std::size_t>(i)];
    challenger.elite.cell = static_cast<std::uint32_t>(i);
    challenger.elite.objective = i;
    challenger.descriptor = {0.1f, static_cast<float>(-72 + 36 * i)};
    challenger.elite.genome = "genome " + std::to_string(i);
    challenger.parent.cell = static_cast<std::uint32_t>(10 + i);
  }
  return challengers;
}

TEST(MostPromising, AreThoseThatAddMostToTheMapInTheirOldOrder) {
  const auto settings = two_dimensions(5);
  const GridCells cells(settings);
  Elites elites(cells.count(), 2);
  elites.put({.cell = 4, .objective = 3.5, .genome = {}},
             std::vector<float>{0.1f, 72.0f});  // leaves 0.5 to gain
  const auto [two, parents] = most_promising(challengers_of(5), 2, cells, elites);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].elite.genome, "genome 2");
  EXPECT_EQ(two[1].elite.genome, "genome 3");
  ASSERT_EQ(parents.size(), 3u) << "of those that are tried no more";
  EXPECT_EQ(parents[0].cell, 10u);
  EXPECT_EQ(parents[2].cell, 14u);
  EXPECT_EQ(most_promising(challengers_of(5), 5, cells, elites).promising.size(), 5u);
  auto unsure = challengers_of(5);
  unsure[3].elite.spread = 100.0;
  EXPECT_EQ(most_promising(unsure, 2, cells, elites).promising[0].elite.genome, "genome 1")
      << "in place of genome 3";
}

TEST(MostPromising, AreOneInEachCellAndThoseThatWereTriedAgainFirst) {
  const auto settings = two_dimensions(5);
  const GridCells cells(settings);
  const Elites elites(cells.count(), 2);
  auto challengers = challengers_of(5);
  challengers[4].elite.cell = 3;
  auto kept = most_promising(challengers, 5, cells, elites).promising;
  ASSERT_EQ(kept.size(), 4u);
  EXPECT_EQ(kept[3].elite.genome, "genome 4") << "more to gain than genome 3 of that cell";
  challengers[3].elite.evaluations = 2;
  kept = most_promising(challengers, 5, cells, elites).promising;
  ASSERT_EQ(kept.size(), 4u);
  EXPECT_EQ(kept[3].elite.genome, "genome 3") << "it was begun with";
  challengers[0].elite.evaluations = 3;
  EXPECT_EQ(most_promising(challengers, 2, cells, elites).promising[0].elite.genome, "genome 0");
}

TEST(Challengers, AreReadBackAsTheyWereAndRefusedIfTheyCannotBe) {
  auto challengers = challengers_of(3);
  challengers[1].elite.spread = 0.25;
  challengers[1].elite.evaluations = 7;
  challengers[2].parent = {.cell = 1, .round = 5, .candidate = 6};
  io::BinaryWriter writer;
  save_challengers(challengers, writer);
  const auto read = [&writer](std::size_t most, std::uint32_t cells, std::size_t length) {
    io::BinaryReader reader(writer.bytes(), "checkpoint.bin");
    auto all = load_challengers(reader, most, cells, length);
    reader.finish();
    return all;
  };
  const auto again = read(3, 25, 2);
  ASSERT_EQ(again.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again[i].elite.cell, challengers[i].elite.cell);
    EXPECT_EQ(again[i].elite.evaluations, challengers[i].elite.evaluations);
    EXPECT_EQ(again[i].elite.objective, challengers[i].elite.objective);
    EXPECT_EQ(again[i].elite.spread, challengers[i].elite.spread);
    EXPECT_EQ(again[i].elite.genome, challengers[i].elite.genome);
    EXPECT_EQ(again[i].descriptor, challengers[i].descriptor);
    EXPECT_EQ(again[i].parent.cell, challengers[i].parent.cell);
    EXPECT_EQ(again[i].parent.candidate, challengers[i].parent.candidate);
  }
  EXPECT_THROW(read(2, 25, 2), UserError) << "more than there can be";
  EXPECT_THROW(read(3, 2, 2), UserError) << "a cell that the map does not have";
  EXPECT_THROW(read(3, 25, 3), UserError) << "another length";
}

}  // namespace
}  // namespace amble::search
