#include "amble/search/map_elites_settings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/core/error.hpp"

namespace amble::search {
namespace {

/// A map with dimensions of these numbers of bins.
MapElitesSettings map_of(const std::vector<int>& bins) {
  MapElitesSettings settings;
  for (const int count : bins) settings.descriptors.emplace_back().bins = count;
  return settings;
}

std::vector<std::string> refused_keys(const MapElitesSettings& settings) {
  try {
    settings.validate();
  } catch (const SettingError& error) {
    return error.keys();
  }
  return {};
}

TEST(MapElitesSettings, HaveTwentyMillionCellsAndNoMore) {
  EXPECT_EQ(map_of({3, 5, 7}).cell_count(), 105u);
  EXPECT_EQ(map_of({20, 1'000'000}).cell_count(), most_cells);
  EXPECT_EQ(map_of({20'000'001}).cell_count(), 0u);
  EXPECT_EQ(map_of({1'000'000, 21}).cell_count(), 0u);
  EXPECT_EQ(map_of({1'000'000, 1'000'000, 1'000'000, 1'000'000}).cell_count(), 0u) << "2⁶⁴ is less";
  EXPECT_TRUE(refused_keys(map_of({1'000'000, 20})).empty());
  EXPECT_EQ(refused_keys(map_of({1'000'000, 21})), std::vector<std::string>{"search.map_elites.descriptors"});
}

TEST(MapElitesSettings, OfACvtArchiveHaveItsCellsWhateverTheBins) {
  MapElitesSettings settings = map_of({1'000'000, 1'000'000});
  settings.archive = Archive::cvt;
  settings.cells = settings.centroid_samples = 77;
  EXPECT_EQ(settings.cell_count(), 77u);
  EXPECT_TRUE(refused_keys(settings).empty()) << "as many points as cells";
  settings.centroid_samples = 76;
  EXPECT_EQ(refused_keys(settings),
            (std::vector<std::string>{"search.map_elites.centroid_samples", "search.map_elites.cells"}));
  settings = map_of({10});
  settings.cells = 77;
  settings.centroid_samples = 76;
  EXPECT_TRUE(refused_keys(settings).empty()) << "a grid has no centroids";
}

TEST(MapElitesSettings, NeedRangesOfSomeWidth) {
  for (const std::size_t dimension : {0u, 1u}) {
    MapElitesSettings settings = map_of({2, 2});
    auto& descriptor = settings.descriptors[dimension];
    descriptor.least = -3.0;
    descriptor.most = -3.0 + 1e-9;
    EXPECT_TRUE(refused_keys(settings).empty());
    descriptor.most = -3.0;
    EXPECT_FALSE(refused_keys(settings).empty());
    descriptor.most = -4.0;
    EXPECT_FALSE(refused_keys(settings).empty());
  }
}

TEST(MapElitesSettings, EvaluateAShareOfABatchAgainAsFarAsThereAreElites) {
  MapElitesSettings settings;
  settings.batch = 10;
  settings.reevaluate_share = 0.25;
  EXPECT_EQ(settings.reevaluations(100), 3u) << "2.5 rounded";
  EXPECT_EQ(settings.reevaluations(3), 3u);
  EXPECT_EQ(settings.reevaluations(2), 2u);
  settings.reevaluate_share = 0.0;
  EXPECT_EQ(settings.reevaluations(100), 0u);
}

TEST(MapElitesSettings, CallADimensionByItsQuantityAndLeg) {
  EXPECT_EQ(DescriptorSettings{}.label(), "duty_factor");
  EXPECT_EQ((DescriptorSettings{.quantity = "phase", .leg = "FL"}).label(), "phase FL");
}

}  // namespace
}  // namespace amble::search
