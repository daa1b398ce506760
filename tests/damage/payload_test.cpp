#include "amble/damage/payload.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/random.hpp"

namespace amble::damage {
namespace {

/// Kinetic energy of a body that turns with `spin` about its own centre of mass.
double spin_energy(const robot::Body& body, Vec3 spin) {
  const Vec3 own = rotate(conjugate(body.inertia_rotation), spin);
  const Vec3 moments = body.inertia_kg_m2;
  return 0.5 * (moments.x * own.x * own.x + moments.y * own.y * own.y + moments.z * own.z * own.z);
}

TEST(Payload, OfADumbbellHasTheMomentsOfTwoPoints) {
  robot::Body body{.name = "b",
                   .position_m = {},
                   .rotation = {},
                   .mass_kg = 2.0,
                   .com_m = {1.0, 0.0, 0.0},
                   .inertia_kg_m2 = {1e-9, 1e-9, 1e-9},
                   .inertia_rotation = {}};
  add_point_mass(body, 6.0, {-1.0, 0.0, 0.0});
  EXPECT_EQ(body.mass_kg, 8.0);
  EXPECT_NEAR(body.com_m.x, -0.5, 1e-15);
  // The reduced mass 2 · 6 / 8 at the distance 2.
  std::array moments{body.inertia_kg_m2.x, body.inertia_kg_m2.y, body.inertia_kg_m2.z};
  std::ranges::sort(moments);
  EXPECT_NEAR(moments[0], 0.0, 1e-8);
  EXPECT_NEAR(moments[1], 6.0, 1e-8);
  EXPECT_NEAR(moments[2], 6.0, 1e-8);
}

TEST(Payload, HasTheEnergyOfBodyAndPointForAnySpin) {
  Stream stream(1, Purpose::trial_noise, 0, 0);
  const auto vector = [&] {
    return Vec3{stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0)};
  };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 axis = vector();
    const robot::Body before{
        .name = "b",
        .position_m = {},
        .rotation = {},
        .mass_kg = stream.uniform(0.1, 5.0),
        .com_m = vector(),
        .inertia_kg_m2 = {stream.uniform(0.1, 0.2), stream.uniform(0.1, 0.2), stream.uniform(0.1, 0.2)},
        .inertia_rotation = axis_angle((1.0 / norm(axis)) * axis, stream.uniform(-3.0, 3.0))};
    const double mass = stream.uniform(0.0, 5.0);
    const Vec3 at = i % 5 == 0 ? before.com_m : vector();
    robot::Body both = before;
    add_point_mass(both, mass, at);
    const Vec3 spin = vector();
    const Vec3 first = cross(spin, before.com_m - both.com_m), second = cross(spin, at - both.com_m);
    const double expected = spin_energy(before, spin) + 0.5 * before.mass_kg * dot(first, first) +
                            0.5 * mass * dot(second, second);
    ASSERT_NEAR(spin_energy(both, spin), expected, 1e-12 * (1.0 + expected)) << i;
    const Vec3 moment = before.mass_kg * before.com_m + mass * at;
    ASSERT_NEAR(norm(both.mass_kg * both.com_m - moment), 0.0, 1e-13) << i;
    const Quat q = both.inertia_rotation;
    ASSERT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14) << i;
    ASSERT_GT(std::min({both.inertia_kg_m2.x, both.inertia_kg_m2.y, both.inertia_kg_m2.z}), 0.0) << i;
  }
}

}  // namespace
}  // namespace amble::damage
