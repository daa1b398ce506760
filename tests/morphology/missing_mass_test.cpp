#include "amble/morphology/missing_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "amble/morphology/convex_hull.hpp"

namespace amble::morphology {
namespace {

robot::Geom geom(robot::Shape shape, Vec3 size_m) {
  robot::Geom geom;
  geom.shape = shape;
  geom.size_m = size_m;
  return geom;
}

TEST(Solid, OfABoxHasTheMomentsOfTextbooks) {
  Solid solid;
  add(solid, geom(robot::Shape::box, {0.1, 0.2, 0.3}), {{1, 2, 3}, {}});
  EXPECT_NEAR(solid.volume_m3, 0.048, 1e-15);
  EXPECT_NEAR(norm(solid.centre_m() - Vec3{1, 2, 3}), 0.0, 1e-12);
  const auto inertia = solid.inertia_kg_m2(6.0);
  EXPECT_NEAR(inertia[0], 6.0 / 12.0 * (0.16 + 0.36), 1e-12);
  EXPECT_NEAR(inertia[4], 6.0 / 12.0 * (0.04 + 0.36), 1e-12);
  EXPECT_NEAR(inertia[8], 6.0 / 12.0 * (0.04 + 0.16), 1e-12);
  EXPECT_NEAR(inertia[1], 0.0, 1e-12);
}

TEST(Solid, OfAMeshIsThatOfTheBoxThatItIs) {
  std::vector<Vec3> corners;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.2, 0.2})
      for (const double z : {-0.3, 0.3}) corners.push_back({x, y, z});
  const ConvexHull hull = convex_hull(corners, 8);
  robot::Geom mesh = geom(robot::Shape::mesh, {});
  mesh.vertices_m = hull.vertices_m;
  mesh.triangles = hull.triangles;
  const robot::Pose pose{{0.5, 0, 0}, {std::cos(0.3), 0, std::sin(0.3), 0}};
  Solid of_mesh, of_box;
  add(of_mesh, mesh, pose);
  add(of_box, geom(robot::Shape::box, {0.1, 0.2, 0.3}), pose);
  EXPECT_NEAR(of_mesh.volume_m3, of_box.volume_m3, 1e-12);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(of_mesh.inertia_kg_m2(1.0)[i], of_box.inertia_kg_m2(1.0)[i], 1e-12);
}

TEST(Solid, OfTwoHalvesIsThatOfTheWhole) {
  Solid halves, whole;
  add(halves, geom(robot::Shape::cylinder, {0.1, 0.2, 0}), {{0, 0, 0.2}, {}});
  add(halves, geom(robot::Shape::cylinder, {0.1, 0.2, 0}), {{0, 0, -0.2}, {}});
  add(whole, geom(robot::Shape::cylinder, {0.1, 0.4, 0}), {});
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(halves.inertia_kg_m2(2.0)[i], whole.inertia_kg_m2(2.0)[i], 1e-12);
  // A capsule without length is a sphere.
  Solid capsule, sphere;
  add(capsule, geom(robot::Shape::capsule, {0.1, 0.0, 0}), {});
  add(sphere, geom(robot::Shape::sphere, {0.1, 0, 0}), {});
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(capsule.inertia_kg_m2(1.0)[i], sphere.inertia_kg_m2(1.0)[i], 1e-12);
}

}  // namespace
}  // namespace amble::morphology
