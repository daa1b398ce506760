#include "amble/search/settings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/search/distance_estimates.hpp"
#include "amble/search/strategies.hpp"

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
    descriptor.least = 0.0;
    for (const double width : {1e-320, 1e-160, 0.9e-9}) {
      descriptor.most = width;
      EXPECT_FALSE(refused_keys(settings).empty()) << width << " by which nothing can be divided";
    }
    descriptor.least = -3.0;
    descriptor.most = -4.0;
    EXPECT_FALSE(refused_keys(settings).empty());
  }
}

TEST(MapElitesSettings, HaveNoMoreDescriptorsThanAPlaceHasNumbers) {
  MapElitesSettings settings = map_of(std::vector<int>(255, 1));
  settings.archive = Archive::cvt;
  EXPECT_TRUE(refused_keys(settings).empty());
  settings.descriptors.emplace_back();
  EXPECT_EQ(refused_keys(settings), std::vector<std::string>{"search.map_elites.descriptors"});
}

TEST(MapElitesSettings, LeaveRoomForANewGenomeInEachBatch) {
  const std::vector<std::string> share{"search.map_elites.batch", "search.map_elites.reevaluate_share"};
  MapElitesSettings settings = map_of({5, 5});
  settings.reevaluate_share = 0.9;
  settings.batch = 5;
  EXPECT_EQ(refused_keys(settings), share) << "4.5 is 5 when rounded";
  settings.batch = 6;
  EXPECT_TRUE(refused_keys(settings).empty());
  settings.trials = 2;
  settings.reevaluate_share = settings.challenger_share = 0.45;
  settings.batch = 4;
  EXPECT_EQ(refused_keys(settings), share) << "1.8 is 2, twice";
}

TEST(MapElitesSettings, CompareNoMoreGenomesWithEachOtherThanTakesSeconds) {
  MapElitesSettings settings = map_of({5, 5});
  settings.batch = 100'000;
  EXPECT_TRUE(refused_keys(settings).empty());
  settings.select = Selection::dominated;
  EXPECT_EQ(refused_keys(settings),
            (std::vector<std::string>{"search.map_elites.batch", "search.map_elites.select"}));
  settings.batch = 10'000;
  EXPECT_TRUE(refused_keys(settings).empty());
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

TEST(MapElitesSettings, ShareABatchOutEvenlyAmongEmittersWhoseCandidatesEnterAtOnce) {
  MapElitesSettings settings = map_of({5, 5});
  settings.variation = Variation::cma;
  settings.cma.emitters = 15;
  settings.batch = 60;
  EXPECT_EQ(refused_keys(settings), std::vector<std::string>{});
  EXPECT_EQ(settings.candidates_per_emitter(), 4);
  const std::vector<std::string> share{"search.map_elites.batch", "search.map_elites.cma.emitters"};
  for (const int batch : {61, 45, 15}) {
    settings.batch = batch;
    EXPECT_EQ(refused_keys(settings), share) << batch;
  }
  settings.batch = 120;
  settings.reevaluate_share = 0.5;
  EXPECT_EQ(settings.candidates_per_emitter(), 4);
  EXPECT_EQ(refused_keys(settings), std::vector<std::string>{});
  settings.trials = 2;
  EXPECT_EQ(refused_keys(settings),
            (std::vector<std::string>{"search.map_elites.trials", "search.map_elites.variation"}));
}

TEST(MapElitesSettings, RefuseWhatHasNoEffectBesideAVariationOfWeightsAlone) {
  MapElitesSettings settings = map_of({5, 5});
  settings.variation = Variation::cma;
  settings.select = Selection::dominated;
  EXPECT_EQ(refused_keys(settings),
            (std::vector<std::string>{"search.map_elites.select", "search.map_elites.variation"}));
  settings.variation = Variation::line;
  EXPECT_EQ(refused_keys(settings), std::vector<std::string>{});
  settings.crossover_probability = 0.5;
  EXPECT_EQ(refused_keys(settings), (std::vector<std::string>{"search.map_elites.crossover_probability",
                                                              "search.map_elites.variation"}));
}

TEST(MapElitesSettings, OfEachVariationFitAtTheirDefaults) {
  for (const Variation variation : {Variation::mutation, Variation::line, Variation::cma}) {
    MapElitesSettings settings = map_of({5, 5});
    settings.variation = variation;
    EXPECT_EQ(refused_keys(settings), std::vector<std::string>{}) << static_cast<int>(variation);
  }
}

class MapElitesMemory : public testing::Test {
 protected:
  MapElitesMemory() {
    settings_.kind = "map-elites";
    settings_.map_elites = map_of({6, 6});
  }
  void check(double memory_bytes) const {
    strategy_kind(settings_).check_memory(
        settings_, {.neat = neat_, .inputs = 3, .outputs = 2, .behaviour_length = 2}, memory_bytes);
  }

  Settings settings_;
  neat::Settings neat_;
};

TEST_F(MapElitesMemory, IsNeededForEachCell) {
  settings_.map_elites.descriptors[0].bins = 100'000;
  EXPECT_NO_THROW(check(1e9));
  EXPECT_THROW(check(1e8), SettingError);
  neat_.innovations.scope = neat::InnovationScope::run;
  EXPECT_THROW(check(1e9), SettingError);
}

TEST_F(MapElitesMemory, IsNeededForEachEmitter) {
  settings_.map_elites.variation = Variation::cma;
  settings_.map_elites.cma.emitters = 1000;
  EXPECT_NO_THROW(check(1e7));
  EXPECT_THROW(check(1e6), SettingError);
}

TEST_F(MapElitesMemory, IsNeededForTheGenomesOfAPool) {
  settings_.map_elites.select = Selection::dominated;
  settings_.map_elites.pool.size = 10'000;
  EXPECT_NO_THROW(check(1e8));
  EXPECT_THROW(check(5e6), SettingError);
}

TEST(MapElitesSettings, CallADimensionByItsQuantityAndLeg) {
  EXPECT_EQ(DescriptorSettings{}.label(), "duty_factor");
  EXPECT_EQ((DescriptorSettings{.quantity = "phase", .leg = "FL"}).label(), "phase FL");
}

template <typename Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "";
}

std::string reading(const std::string& line) {
  return error_of([&] {
    NoveltySettings settings;
    auto document = io::TomlDocument::parse("", "c.toml");
    document.set(line);
    const auto reader = document.reader();
    settings.describe(*reader);
    reader->finish();
  });
}

TEST(NoveltySettings, HaveARangeEach) {
  for (const char* line :
       {"path_stride=0",       "neighbours=0",        "neighbours=-3",   "threshold=0",
        "threshold=-1",        "threshold=nan",       "threshold=inf",   "first_members=-1",
        "raise_above=-1",      "raise_factor=0.9",    "lower_after=0",   "lower_factor=1.1",
        "lower_factor=0",      "lowest_threshold=-1", "archive_limit=0", "distance=manhattan",
        "compare_with=nobody", "lowering=never",      "path_stride=1.5", "path_first_step=0"})
    EXPECT_NE(reading(line).find("expected"), std::string::npos) << line << ": " << reading(line);
  for (const char* line :
       {"path_stride=1", "neighbours=1", "threshold=0.1", "first_members=0", "raise_above=0",
        "raise_factor=1", "lower_after=1", "lower_factor=1", "lowest_threshold=0.25", "archive_limit=1",
        "distance=root", "compare_with=archive_and_population", "lowering=count_anew"})
    EXPECT_EQ(reading(line), "") << line;
}

TEST(NoveltySettings, RefuseAStrideLongerThanATrialAndBehavioursWithoutBound) {
  NoveltySettings settings;
  settings.path_stride = 2000;
  EXPECT_EQ(error_of([&] { settings.validate(0); }),
            "search.novelty.path_stride = 2000: expected at most the steps of a trial");
  settings.path_stride = 1;
  EXPECT_EQ(
      error_of([&] { settings.validate(2000000); }),
      "search.novelty.path_stride = 1: behaviours of 2000000 numbers; expected at most 1000000, by a larger "
      "stride");
  EXPECT_EQ(error_of([&] { settings.validate(1000000); }), "");
  settings.path_first_step = 2;
  EXPECT_EQ(error_of([&] { settings.validate(1000000); }),
            "search.novelty.path_first_step = 2: expected at most search.novelty.path_stride, 1");
}

TEST(NoveltySettings, RefuseAnArchiveLargerThanMemoryAndSayHowLargeItMayBe) {
  NoveltySettings settings;
  settings.archive_limit = 1000000;
  // 1500 floats, two doubles and 300 floats: 7216 bytes for each member, and for each of a generation of 300.
  EXPECT_EQ(
      error_of([&] { settings.check_memory(1500, 300, 4e9); }),
      "search.novelty.archive_limit = 1000000: that many behaviours of 1500 numbers need 7.2 GB; expected at "
      "most 554023, for the 4.0 GB that this process may use");
  EXPECT_EQ(error_of([&] { settings.check_memory(1500, 300, 7.216e9 + 300 * 7216); }), "");
  settings.archive_limit = 554023;
  EXPECT_EQ(error_of([&] { settings.check_memory(1500, 300, 4e9); }), "");
  settings.archive_limit = 554024;
  EXPECT_NE(error_of([&] { settings.check_memory(1500, 300, 4e9); }), "");
}

TEST(NoveltySettings, DrawTheirLimitsWhereTheMessagesSay) {
  NoveltySettings settings;
  EXPECT_EQ(error_of([&] { settings.validate(1); }), "");
  EXPECT_EQ(error_of([&] { settings.validate(longest_behaviour); }), "");
  EXPECT_NE(error_of([&] { settings.validate(longest_behaviour + 1); }).find("by a larger stride"),
            std::string::npos);
  settings.path_stride = settings.path_first_step = 7;
  EXPECT_EQ(error_of([&] { settings.validate(1); }), "");
  settings.path_first_step = 8;
  EXPECT_NE(error_of([&] { settings.validate(1); }), "");
}

TEST(NoveltySettings, NameTheKeysThatCouldBeChanged) {
  const auto keys = [](const auto& call) -> std::vector<std::string> {
    try {
      call();
    } catch (const SettingError& error) {
      return error.keys();
    }
    return {};
  };
  using Keys = std::vector<std::string>;
  NoveltySettings settings;
  const Keys length{"search.novelty.path_stride", "trial.duration_s"};
  EXPECT_EQ(keys([&] { settings.validate(0); }), length);
  EXPECT_EQ(keys([&] { settings.validate(longest_behaviour + 1); }), length);
  EXPECT_EQ(keys([&] { settings.check_memory(10, 10, 1e4); }), Keys{"search.novelty.archive_limit"});
  EXPECT_EQ(keys([&] { settings.check_memory(10, 100'000, 20e9); }), Keys{"population.size"})
      << "each with each: 40 GB, however small the archive";
  settings.path_first_step = 3;
  EXPECT_EQ(keys([&] { settings.validate(1); }),
            (Keys{"search.novelty.path_first_step", "search.novelty.path_stride"}));
}

}  // namespace

}  // namespace amble::search
