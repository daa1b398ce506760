#include "amble/search/cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "amble/core/random.hpp"

namespace amble::search {
namespace {

DescriptorSettings dimension(double least, double most, int bins) {
  DescriptorSettings settings;
  settings.least = least;
  settings.most = most;
  settings.bins = bins;
  return settings;
}

TEST(GridCells, NumberTheirBinsAsDigits) {
  const GridCells cells(std::array{dimension(0.0, 1.0, 4), dimension(-2.0, 2.0, 8)});
  EXPECT_EQ(cells.count(), 32u);
  EXPECT_EQ(cells.of(std::array{0.0f, -2.0f}), 0u);
  EXPECT_EQ(cells.of(std::array{0.0f, -1.4f}), 1u);
  EXPECT_EQ(cells.of(std::array{0.25f, -2.0f}), 8u) << "a border belongs to the bin above it";
  EXPECT_EQ(cells.of(std::array{0.99f, 1.99f}), 31u);
}

TEST(GridCells, TakeWhatIsOutsideTheRangeForItsEnds) {
  const GridCells cells(std::array{dimension(0.0, 1.0, 5), dimension(0.0, 1.0, 5)});
  EXPECT_EQ(cells.of(std::array{1.0f, 1.0f}), 24u);
  EXPECT_EQ(cells.of(std::array{1e30f, -1e30f}), 20u);
  EXPECT_EQ(cells.of(std::array{-0.1f, 7.0f}), 4u);
}

/// The nearest by looking at all of them.
std::uint32_t nearest_of_all(const std::vector<float>& centroids, std::span<const float> point) {
  const std::size_t dimensions = point.size();
  std::uint32_t best = 0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < centroids.size() / dimensions; ++i) {
    double distance = 0.0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double difference = double{centroids[i * dimensions + d]} - double{point[d]};
      distance += difference * difference;
    }
    if (distance < best_distance) best_distance = distance, best = i;
  }
  return best;
}

TEST(CentroidCells, AreThoseOfTheNearestCentroidAndOfEqualOnesOfTheFirst) {
  Stream stream(1, Purpose::test);
  for (const std::size_t dimensions : {1u, 2u, 3u, 6u, 10u})
    for (const int count : {1, 2, 7, 200}) {
      std::vector<float> centroids(dimensions * static_cast<std::size_t>(count));
      // Coarse numbers: many centroids are the same, many points as near to two.
      for (float& value : centroids) value = static_cast<float>(stream.below(9)) / 8.0f;
      const CentroidCells cells(std::vector<DescriptorSettings>(dimensions), centroids);
      for (int i = 0; i < 500; ++i) {
        std::vector<float> point(dimensions);
        const bool coarse = stream.chance(0.5);
        for (float& value : point)
          value =
              coarse ? static_cast<float>(stream.below(17)) / 16.0f : static_cast<float>(stream.uniform());
        ASSERT_EQ(cells.of(point), nearest_of_all(centroids, point)) << dimensions << ", " << count;
      }
    }
}

TEST(CentroidCells, ScaleEachDimensionToItsRange) {
  const std::vector<float> centroids{0.25f, 0.5f, 0.75f, 0.5f};
  const CentroidCells cells(std::array{dimension(-10.0, 10.0, 1), dimension(0.0, 1e-3, 1)}, centroids);
  EXPECT_EQ(cells.of(std::array{-1.0f, 1e-3f}), 0u);
  EXPECT_EQ(cells.of(std::array{1.0f, 0.0f}), 1u);
  EXPECT_EQ(cells.of(std::array{1000.0f, 0.0f}), 1u);
}

TEST(Centroids, HaveCellsOfMoreEqualSizeThanRandomPoints) {
  constexpr std::size_t count = 100, dimensions = 2;
  const auto largest_share = [&](std::vector<float> centroids) {
    const CentroidCells cells(std::vector<DescriptorSettings>(dimensions), std::move(centroids));
    Stream stream(2, Purpose::test);
    std::vector<int> hits(count);
    for (int i = 0; i < 20000; ++i)
      ++hits[cells.of(
          std::array{static_cast<float>(stream.uniform()), static_cast<float>(stream.uniform())})];
    return *std::ranges::max_element(hits) / 20000.0;
  };
  std::vector<float> random(count * dimensions);
  Stream stream(3, Purpose::test);
  for (float& value : random) value = static_cast<float>(stream.uniform());
  const double spread = largest_share(spread_centroids(count, dimensions, 10000, 1));
  EXPECT_LT(spread, 0.02);
  EXPECT_GT(largest_share(random), 1.3 * spread);
}

/// Lloyd's algorithm point by point, on the points that the stream of the seed gives.
std::vector<float> plain_centroids(std::size_t count, std::size_t dimensions, std::size_t samples,
                                   std::uint64_t seed) {
  Stream stream(seed, Purpose::centroids);
  std::vector<std::vector<float>> points(samples, std::vector<float>(dimensions));
  for (auto& point : points)
    for (float& value : point) value = static_cast<float>(stream.uniform());
  std::vector<float> centroids;
  for (std::size_t i = 0; i < count; ++i)
    centroids.insert(centroids.end(), points[i].begin(), points[i].end());
  std::vector<std::uint32_t> before;
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint32_t> nearest;
    nearest.reserve(samples);
    for (const auto& point : points) nearest.push_back(nearest_of_all(centroids, point));
    if (nearest == before) break;
    before = nearest;
    for (std::uint32_t cell = 0; cell < count; ++cell)
      for (std::size_t d = 0; d < dimensions; ++d) {
        double sum = 0.0, members = 0.0;
        for (std::size_t i = 0; i < samples; ++i)
          if (nearest[i] == cell) sum += double{points[i][d]}, members += 1.0;
        if (members > 0.0) centroids[cell * dimensions + d] = static_cast<float>(sum / members);
      }
  }
  return centroids;
}

TEST(Centroids, AreThoseOfLloydsAlgorithmAlsoOfCellsWithOnePoint) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const std::size_t dimensions : {1u, 2u, 4u})
      for (const auto& [count, samples] : {std::pair{1u, 1u}, {8u, 8u}, {10u, 17u}, {20u, 60u}, {5u, 300u}})
        EXPECT_EQ(spread_centroids(count, dimensions, samples, seed),
                  plain_centroids(count, dimensions, samples, seed))
            << count << " of " << samples << " points, seed " << seed;
}

TEST(Centroids, DependOnTheSeedAlone) {
  EXPECT_EQ(spread_centroids(20, 3, 500, 5), spread_centroids(20, 3, 500, 5));
  EXPECT_NE(spread_centroids(20, 3, 500, 5), spread_centroids(20, 3, 500, 6));
}

TEST(Cells, AreMadeAsTheSettingsSay) {
  MapElitesSettings settings;
  settings.descriptors = {dimension(0.0, 1.0, 3), dimension(0.0, 1.0, 4)};
  EXPECT_EQ(make_cells(settings)->count(), 12u);
  EXPECT_EQ(settings.cell_count(), 12u);
  settings.archive = Archive::cvt;
  settings.cells = 17;
  settings.centroid_samples = 100;
  EXPECT_EQ(make_cells(settings)->count(), 17u);
  EXPECT_EQ(settings.cell_count(), 17u);
}

}  // namespace
}  // namespace amble::search
