#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::morphology {

/// A convex polyhedron: corners, and triangles that are counter-clockwise as seen from outside.
struct ConvexHull {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<int, 3>> triangles;
};

/// The convex hull of points, with at most `most_vertices` (≥ 4) of them as corners: where there are more,
/// those that enlarge the hull most, one by one (quickhull with the farthest point of all faces first;
/// Barber, Dobkin & Huhdanpaa 1996), so that it lies within the true hull. Empty for points that lie in a
/// plane.
ConvexHull convex_hull(std::span<const Vec3> points_m, std::size_t most_vertices);

}  // namespace amble::morphology
