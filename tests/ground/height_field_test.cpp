#include "amble/ground/height_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/random.hpp"

namespace amble::ground {
namespace {

Settings of_kind(const std::string& kind) {
  Settings settings;
  settings.kind = kind;
  settings.height_m = 0.1;
  return settings;
}

const std::array<std::string, 6> with_field{"hills", "rough", "stones", "blocks", "stairs", "hurdles"};

std::uint64_t hash_of(const HeightField& field) {
  return hash_span<float>(field.heights_m());
}

TEST(HeightField, IsBilinearBetweenItsNodes) {
  HeightField field(0.5);
  field.node(0, 0) = 1.0f;
  field.node(1, 0) = 3.0f;
  field.node(0, 1) = 2.0f;
  field.node(1, 1) = 8.0f;
  // h = a + s (b − a) + t (c − a) + s t (a − b − c + d), s = x / cell, t = y / cell.
  for (const double s : {0.0, 0.25, 0.9})
    for (const double t : {0.0, 0.5, 0.75}) {
      const auto at = field.at(0.5 * s, 0.5 * t);
      EXPECT_NEAR(at.height_m, 1.0 + 2.0 * s + t + 4.0 * s * t, 1e-12);
      EXPECT_NEAR(at.slope_x, (2.0 + 4.0 * t) / 0.5, 1e-12);
      EXPECT_NEAR(at.slope_y, (1.0 + 4.0 * s) / 0.5, 1e-12);
    }
}

TEST(HeightField, RepeatsItselfInBothDirections) {
  const HeightField field = make_field(of_kind("hills"), {});
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const double x = stream.uniform(-5.0, 5.0), y = stream.uniform(-5.0, 5.0);
    for (const double periods : {-3.0, 1.0, 20.0}) {
      EXPECT_NEAR(field.at(x + periods * field.period_m(), y).height_m, field.at(x, y).height_m, 1e-9);
      EXPECT_NEAR(field.at(x, y + periods * field.period_m()).height_m, field.at(x, y).height_m, 1e-9);
    }
  }
  EXPECT_NO_FATAL_FAILURE(field.at(1e300, -1e300));
}

TEST(MakeField, IsFlatEverywhereOnThePlane) {
  const HeightField field = make_field(of_kind("plane"), {});
  EXPECT_EQ(field.heights_m(), HeightField(field.cell_m()).heights_m());
}

TEST(MakeField, IsFlatAroundTheOriginAndAsHighAsItsSettingsSay) {
  for (const std::string& kind : with_field) {
    Settings settings = of_kind(kind);
    const HeightField field = make_field(settings, {});
    for (double x = -0.42; x <= 0.42; x += 0.02)
      for (double y = -0.42; y <= 0.42; y += 0.02)
        if (x * x + y * y < 0.55 * 0.55) {
          ASSERT_EQ(field.at(x, y).height_m, 0.0) << kind;
        }
    const auto [low, high] = std::ranges::minmax(field.heights_m());
    if (kind == "blocks" || kind == "hurdles") {
      EXPECT_EQ(low, 0.0f);
      EXPECT_FLOAT_EQ(high, 0.1f);
    } else if (kind == "stairs") {
      EXPECT_EQ(low, 0.0f);
      EXPECT_NEAR(std::remainder(high, 0.1f), 0.0f, 1e-6f);
      EXPECT_GT(high, 0.3f);
    } else {
      EXPECT_GE(low, -0.0501f);
      EXPECT_LE(high, 0.0501f);
      EXPECT_GT(high - low, 0.06f);
    }
    settings.height_m = 0.0;
    EXPECT_EQ(make_field(settings, {}).highest_m(), 0.0f);
  }
}

TEST(MakeField, HasStepsAndWallsWhereTheSettingsPutThem) {
  Settings settings = of_kind("stairs");  // flat to 0.6 m, steps every 0.5 m
  const HeightField stairs = make_field(settings, {});
  for (const double away : {0.8, -0.8}) {
    EXPECT_NEAR(stairs.at(away, 0.0).height_m, 0.1, 1e-6);
    EXPECT_NEAR(stairs.at(0.3, away + std::copysign(0.5, away)).height_m, 0.2, 1e-6);
  }
  settings.kind = "hurdles";
  const HeightField hurdles = make_field(settings, {});
  EXPECT_EQ(hurdles.at(0.9, 0.1).height_m, 0.0);
  EXPECT_NEAR(hurdles.at(1.06, 0.1).height_m, 0.1, 1e-6);  // the wall ends at 1.1 m
  EXPECT_EQ(hurdles.at(1.2, 0.1).height_m, 0.0);
}

TEST(MakeField, MissesNoWallBetweenTwoPlaces) {
  Settings settings;
  settings.kind = "hurdles";
  settings.cell_m = 0.1;
  settings.length_m = 1.0;
  EXPECT_THROW(settings.validate(), SettingError);
  settings.cell_m = hurdle_m;
  EXPECT_NO_THROW(settings.validate());
  EXPECT_GT(make_field(settings, {}).highest_m(), 0.0f);
}

TEST(MakeField, GivesTheSameGroundForEver) {
  std::string hashes;
  for (const std::string& kind : with_field)
    hashes += std::to_string(hash_of(make_field(of_kind(kind), {}))) + ' ';
  EXPECT_EQ(hash_bytes(hashes.data(), hashes.size()), 9551029394869960990u) << hashes;
}

TEST(MakeField, VariesWithTheSeedAndIfAskedToWithRunAndGeneration) {
  Settings settings = of_kind("rough");
  const Key first{.seed = 1, .generation = 3}, later{.seed = 1, .generation = 4},
      other{.seed = 2, .generation = 3}, unseen{.seed = 1, .generation = 3, .set = 1};
  const auto different = [&] {
    std::set<std::uint64_t> hashes;
    for (const Key& key : {first, later, other, unseen}) hashes.insert(hash_of(make_field(settings, key)));
    return hashes.size();
  };
  EXPECT_EQ(different(), 2u) << "only what evolution never meets is another";
  const auto of_seed_1 = hash_of(make_field(settings, first));
  settings.seed = 2;
  EXPECT_NE(hash_of(make_field(settings, first)), of_seed_1);
  settings.vary = Vary::generations;
  EXPECT_EQ(different(), 4u);
}

TEST(MakeField, GrowsOverTheGenerationsOfACurriculum) {
  Settings settings = of_kind("blocks");
  settings.grow_generations = 10;
  const std::array<std::pair<unsigned, float>, 4> heights{{{0, 0.0f}, {3, 0.03f}, {10, 0.1f}, {500, 0.1f}}};
  for (const auto& [generation, height_m] : heights)
    EXPECT_FLOAT_EQ(make_field(settings, {.generation = generation}).highest_m(), height_m);
  EXPECT_FLOAT_EQ(make_field(settings, {.generation = 0, .set = 1}).highest_m(), 0.1f)
      << "what judges champions has the whole height";
}

TEST(Normalised, IsTheSameForKeysOfTheSameFieldAndForNoOthers) {
  for (const Vary vary : {Vary::never, Vary::generations})
    for (const int grow : {0, 5}) {
      Settings settings = of_kind("hills");
      settings.vary = vary;
      settings.grow_generations = grow;
      std::vector<Key> keys;
      for (const std::uint64_t seed : {1u, 2u})
        for (const std::uint32_t generation : {0u, 4u, 5u, 6u})
          for (const std::uint32_t set : {0u, 1u}) keys.push_back({seed, generation, set});
      std::vector<decltype(hash_of(make_field(settings, Key{})))> hashes;
      for (const Key& key : keys) {
        hashes.push_back(hash_of(make_field(settings, key)));
        EXPECT_EQ(hash_of(make_field(settings, normalised(settings, key))), hashes.back());
      }
      for (std::size_t a = 0; a < keys.size(); ++a)
        for (std::size_t b = 0; b < keys.size(); ++b)
          EXPECT_EQ(normalised(settings, keys[a]) == normalised(settings, keys[b]), hashes[a] == hashes[b]);
    }
}

TEST(OffsetField, IsTheHighestPlaceUnderTheBall) {
  const double radius_m = 0.09;
  const HeightField field = make_field(of_kind("rough"), {});
  const HeightField offset = offset_field(field, radius_m);
  Stream stream(2, Purpose::test);
  for (int n = 0; n < 200; ++n) {
    const int i = static_cast<int>(stream.below(256)), j = static_cast<int>(stream.below(256));
    // By brute force, on a hundred times as many places.
    double highest_m = -1.0;
    for (double y = -radius_m; y <= radius_m; y += 0.001)
      for (double x = -radius_m; x <= radius_m; x += 0.001) {
        const double square = radius_m * radius_m - x * x - y * y;
        if (square >= 0.0)
          highest_m = std::max(highest_m, std::sqrt(square) + field.at(i * 0.04 + x, j * 0.04 + y).height_m);
      }
    EXPECT_LE(offset.node(i, j), highest_m + 1e-6);
    EXPECT_GT(offset.node(i, j), highest_m - 5e-4);
  }
}

TEST(OffsetField, OfAPlaneIsThePlaneRaisedAlongItsNormal) {
  // h = x / 2: the ball's centre is r √(1 + ¼) over it. Away from the jump where the field repeats.
  HeightField field(0.04);
  for (int j = 0; j < 256; ++j)
    for (int i = -128; i < 128; ++i) field.node(i, j) = 0.02f * static_cast<float>(i);
  for (const double radius_m : {0.03, 0.1, 0.5})
    for (const double x : {-1.0, 0.33, 1.7})
      EXPECT_NEAR(offset_field(field, radius_m).at(x, 0.1).height_m, 0.5 * x + radius_m * std::sqrt(1.25),
                  0.01 * radius_m);
}

TEST(OffsetField, OfTheLevelGroundIsTheRadiusToTheBit) {
  for (const double radius_m : {0.01, 0.045, 0.1, 0.7}) {
    const HeightField offset = offset_field(HeightField(0.04), radius_m);
    for (const float height_m : offset.heights_m()) ASSERT_EQ(height_m, static_cast<float>(radius_m));
  }
}

TEST(HeightField, RepeatsItselfToTheBitHoweverFarAway) {
  // Places and periods are exact in binary.
  HeightField field(0.5);
  Stream stream(2, Purpose::test);
  for (float& height_m : field.heights_m()) height_m = static_cast<float>(stream.uniform());
  for (int i = 0; i < 200; ++i) {
    const double x = 0.125 * stream.below(1024), y = 0.125 * stream.below(1024);
    for (const double away : {0x1p20, -0x1p30, 0x1p38, -0x1p38}) {
      EXPECT_EQ(field.at(x + away, y).height_m, field.at(x, y).height_m) << x << " " << away;
      EXPECT_EQ(field.at(x, y + away).height_m, field.at(x, y).height_m) << y << " " << away;
    }
  }
}

TEST(MakeField, HasWholeStepsAndWallsOnlyAndNoneAcrossTheSeamWhereItRepeats) {
  Stream stream(3, Purpose::test);
  for (int n = 0; n < 15; ++n) {
    Settings settings = of_kind("hurdles");
    settings.length_m = stream.uniform(0.1, 2.0);
    settings.start_radius_m = stream.uniform(0.0, 3.0);
    // By turns the last length is all but whole where the ground begins to repeat.
    const double room_m = 128 * settings.cell_m - settings.start_radius_m;
    if (n % 2 == 0) settings.length_m = (room_m + 0.05) / std::ceil(room_m / settings.length_m);
    const HeightField hurdles = make_field(settings, {});
    settings.kind = "stairs";
    const HeightField stairs = make_field(settings, {});
    const double last_m = 0.5 * stairs.period_m() - settings.start_radius_m;
    for (int i = -128; i < 128; ++i)
      for (const int j : {0, i / 2, i}) {
        const double away_m = std::abs(i) * settings.cell_m - settings.start_radius_m;
        const double in_length_m = away_m - std::floor(away_m / settings.length_m) * settings.length_m;
        const double to_border_m = std::min(in_length_m, settings.length_m - in_length_m);
        if (to_border_m < 1e-9 || std::abs(in_length_m - (settings.length_m - 0.08)) < 1e-9) continue;
        // A wall is the last 8 cm of a length, of those that fit in whole.
        const bool whole = away_m > 0.0 && away_m - in_length_m + settings.length_m <= last_m;
        const bool wall = whole && in_length_m > settings.length_m - 0.08;
        ASSERT_FLOAT_EQ(hurdles.node(i, j), wall ? 0.1f : 0.0f) << settings.length_m << " " << i << " " << j;
        // Up and down by at most a step at a time, in both directions.
        ASSERT_LE(std::abs(stairs.node(i + 1, j) - stairs.node(i, j)), 0.1001f)
            << settings.length_m << " " << i;
        ASSERT_LE(std::abs(stairs.node(j, i + 1) - stairs.node(j, i)), 0.1001f)
            << settings.length_m << " " << i;
      }
  }
}

}  // namespace
}  // namespace amble::ground
