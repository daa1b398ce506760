#include <gtest/gtest.h>

#include <ostream>

#include "amble/core/hash.hpp"
#include "amble/ground/height_field.hpp"
#include "tests/same_bits/walker.hpp"

// What the champions' files do not have: noise, uneven ground, and damaged robots.
namespace amble::tests {
namespace {

struct Walks {
  const char* robot;
  const char* under_noise;   ///< hash of two trials under its champion's noise
  const char* on_grounds;    ///< hash of trials on each kind of ground
  const char* with_damages;  ///< hash of trials with each kind of damage
};

void PrintTo(const Walks& walks, std::ostream* out) {
  *out << walks.robot;
}

class GoldenWalk : public testing::TestWithParam<Walks> {
 protected:
  GoldenWalk() { walker_.trial.duration_s = 2.0; }

  Walker walker_{GetParam().robot};
};

TEST_P(GoldenWalk, UnderNoiseIsTheSameEverywhere) {
  std::uint64_t hash = 0;
  for (const std::uint32_t episode : {1u, 1000u}) {
    const trial::Scenario scenario = walker_.scenario(episode);
    hash = hash_span<std::uint32_t>(walker_.trace(&scenario), hash);
  }
  EXPECT_EQ(hex(hash), GetParam().under_noise);
}

TEST_P(GoldenWalk, OnUnevenGroundIsTheSameEverywhere) {
  std::uint64_t hash = 0;
  for (const char* kind : {"hills", "rough", "stones", "blocks", "stairs", "hurdles"}) {
    const ground::Settings settings{.kind = kind, .height_m = 0.03, .length_m = 0.3, .start_radius_m = 0.2};
    const auto field = ground::make_field(settings, {});
    const auto trace = walker_.trace(nullptr, std::make_shared<const ground::Ground>(field, walker_.robot));
    hash = hash_span<float>(field.heights_m(), hash);
    hash = hash_span<std::uint32_t>(trace, hash);
  }
  EXPECT_EQ(hex(hash), GetParam().on_grounds);
}

TEST_P(GoldenWalk, OfADamagedRobotIsTheSameEverywhere) {
  using damage::Kind;
  const std::string leg = walker_.robot.legs[1].name, joint = walker_.robot.joints[2].name;
  std::uint64_t hash = 0;
  for (damage::Part part : {damage::Part{.kind = Kind::locked, .joint = joint, .angle_rad = 0.1},
                            damage::Part{.kind = Kind::slack, .joint = joint},
                            damage::Part{.kind = Kind::weak, .joint = joint, .share = 0.3},
                            damage::Part{.kind = Kind::payload, .mass_kg = 0.4, .x_m = 0.1, .y_m = 0.05}})
    for (const double from_s : {0.0, 1.0}) {
      part.from_s = from_s;
      hash = hash_span<std::uint32_t>(walker_.trace(nullptr, nullptr, {{part}}), hash);
    }
  EXPECT_EQ(hex(hash), GetParam().with_damages);
}

INSTANTIATE_TEST_SUITE_P(
    SameBits, GoldenWalk,
    testing::Values(Walks{"biped", "5eea56a58cbef50e", "8d7e58c2db506ed6", "4f34ac0cc8e2efb9"},
                    Walks{"hexapod", "1202f205bbe0dfb4", "36351452eb38aa99", "28603c475bb35856"},
                    Walks{"octopod", "28a1df81dbbf4676", "74c917de757bef5c", "5cf6f947d094dce4"},
                    Walks{"servo", "cecfc41f583e015f", "0030d94e7649e5f9", "012e0ac44d0721e5"}),
    [](const auto& walks) { return std::string(walks.param.robot); });

}  // namespace
}  // namespace amble::tests
